#include "common/optics/indirect.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/base/rng.h"
#include "common/base/sobol.h"
#include "common/optics/camera_hits.h"
#include "common/optics/light_path.h"

namespace tacipc {
namespace {

constexpr double kOffset = 1e-6;  // m: keeps rays off the triangles around their vertex

/// Return of a ray that meets nothing in the gel: it is mirrored at the layers.
struct Mirrored {
  Vector3 origin;     // on the gel's back
  Vector3 direction;  // towards the membrane
  double reflectance;
};

std::optional<Mirrored> mirrored(const Vector3& origin, const Vector3& direction, const Sensor& sensor) {
  const OpticalStack& stack = sensor.stack;
  const double down = -direction.z();
  if (down < 1e-3) return std::nullopt;
  double index = *stack.gel_ior, sine = std::sqrt(std::max(0.0, 1.0 - down * down));
  const double through_gel = (origin.z() + stack.gel_thickness_m) * sine / down;  // lateral displacement
  double through_layers = 0.0, reflectance = 1.0;
  bool total = false;
  for (const Layer& layer : stack.layers) {
    const double bent = sine * index / layer.ior;
    if (bent >= 1.0) {  // total reflection at this interface
      total = true;
      break;
    }
    sine = bent;
    index = layer.ior;
    through_layers += layer.thickness_m * sine / std::sqrt(1.0 - sine * sine);
  }
  if (!total) reflectance = fresnel_reflectance(sine, index, 1.0);
  const Eigen::Vector2d sideways =
      direction.head<2>().norm() > 0.0 ? Eigen::Vector2d(direction.head<2>().normalized()) : Eigen::Vector2d::Zero();
  const Eigen::Vector2d turn = origin.head<2>() + (through_gel + through_layers) * sideways;
  if (!sensor.gel.contains(turn.x(), turn.y())) return std::nullopt;
  const Eigen::Vector2d back = turn + through_layers * sideways;
  return Mirrored{.origin = {back.x(), back.y(), -stack.gel_thickness_m},
                  .direction = {direction.x(), direction.y(), down},
                  .reflectance = reflectance};
}

}  // namespace

double fresnel_reflectance(double sine, double from, double to) {
  const double bent = sine * from / to;
  if (bent >= 1.0) return 1.0;
  const double a = from * std::sqrt(1.0 - sine * sine), b = to * std::sqrt(1.0 - bent * bent);
  const double rs = (a - b) / (a + b);
  const double c = to * std::sqrt(1.0 - sine * sine), d = from * std::sqrt(1.0 - bent * bent);
  const double rp = (c - d) / (c + d);
  return 0.5 * (rs * rs + rp * rp);
}

VertexLight direct_vertex_light(const RayScene& scene, const Membrane& membrane, const Sensor& sensor, int led_samples,
                                bool refract) {
  const auto samples = light_samples(sensor, led_samples, refract);
  const auto groups = static_cast<Eigen::Index>(light_groups(sensor.leds).size());
  const Eigen::Index count = membrane.positions.rows();
  VertexLight light = VertexLight::Zero(count, groups);
  const Coating paper{.albedo = {1.0, 1.0, 1.0}};
  tbb::parallel_for(Eigen::Index{0}, (count + kLanes - 1) / kLanes, [&](Eigen::Index block) {
    const FlushDenormals flush;
    SurfacePack surface{};
    for (int l = 0; l < kLanes; ++l) {
      const Eigen::Index v = std::min(block * kLanes + l, count - 1);
      put(surface.point, l, membrane.positions.row(v));
      put(surface.normal, l, -membrane.normals.row(v));
    }
    surface.view = surface.normal;
    surface.shadow_origin = surface.point + (Pack{} + kOffset) * surface.normal;
    for (const LightSample& sample : samples) {
      const IncidencePack incidence = light_path(surface.point, sample);
      const Pack radiance = incidence.irradiance * coating_response(surface, incidence.direction, paper).diffuse;
      RayPacket shadow;
      for (int l = 0; l < kLanes; ++l)
        shadow.set(l, lane_of(surface.shadow_origin, l), lane_of(incidence.direction, l), incidence.length[l]);
      const std::uint32_t blocked = scene.blocked(shadow);
      for (int l = 0; l < kLanes && block * kLanes + l < count; ++l) {
        if ((blocked >> l & 1u) == 0 && radiance[l] > 0.0) light(block * kLanes + l, sample.group) += radiance[l];
      }
    }
  });
  return light;
}

VertexLight gather_indirect(const RayScene& scene, const Membrane& membrane, const VertexLight& light,
                            const Sensor& sensor, int rays, bool refract) {
  constexpr std::uint64_t kShiftStream = 4;
  const bool mirrors = refract && sensor.stack.refracts();
  VertexLight out = VertexLight::Zero(light.rows(), light.cols());
  tbb::parallel_for(Eigen::Index{0}, membrane.positions.rows(), [&](Eigen::Index v) {
    const FlushDenormals flush;
    const Vector3 normal = -membrane.normals.row(v).transpose();
    if (normal.squaredNorm() < 0.5) return;
    const Vector3 origin = membrane.positions.row(v).transpose() + kOffset * normal;
    const Vector3 first = normal.unitOrthogonal(), second = normal.cross(first);
    const auto vertex = static_cast<std::uint64_t>(v);
    const double shift_x = random_uniform(0, kShiftStream, 2 * vertex);
    const double shift_y = random_uniform(0, kShiftStream, 2 * vertex + 1);
    const auto add = [&](int triangle, double weight) {
      for (int k = 0; k < 3; ++k) out.row(v) += weight / 3.0 * light.row(membrane.triangles(triangle, k));
    };
    for (int start = 0; start < rays; start += kLanes) {
      RayPacket packet;
      std::array<Vector3, kLanes> directions;
      for (int l = 0; l < kLanes; ++l) {
        const auto index = static_cast<std::uint32_t>(start + l);
        const double u = std::fmod(sobol(index, 0) + shift_x, 1.0), w = std::fmod(sobol(index, 1) + shift_y, 1.0);
        const double sine = std::sqrt(u), azimuth = 2.0 * std::numbers::pi * w;
        directions[l] =
            sine * std::cos(azimuth) * first + sine * std::sin(azimuth) * second + std::sqrt(1.0 - u) * normal;
        packet.set(l, origin, directions[l], 0.0);
      }
      const auto met = scene.first_hits(packet);
      RayPacket returning = packet;
      returning.valid = 0;
      std::array<double, kLanes> weights{};
      for (int l = 0; l < kLanes; ++l) {
        if (met[l] >= 0) {
          add(met[l], 1.0);
        } else if (mirrors) {
          const auto back = mirrored(origin, directions[l], sensor);
          if (!back) continue;
          returning.set(l, back->origin, back->direction, 0.0);
          weights[l] = back->reflectance;
        }
      }
      if (returning.valid == 0) continue;
      const auto reached = scene.first_hits(returning);
      for (int l = 0; l < kLanes; ++l) {
        if ((returning.valid >> l & 1u) != 0 && reached[l] >= 0) add(reached[l], weights[l]);
      }
    }
    out.row(v) /= (rays + kLanes - 1) / kLanes * kLanes;
  });
  return out;
}

}  // namespace tacipc
