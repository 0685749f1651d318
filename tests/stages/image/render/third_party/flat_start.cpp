#include "tests/stages/image/render/third_party/flat_start.h"

#include <Eigen/Geometry>
#include <array>
#include <cassert>
#include <numbers>
#include <vector>

#include "common/optics/ray_scene.h"
#include "common/optics/surface_hit.h"
#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

constexpr double kOffset = 2e-9;  // m: what single precision needs not to meet the triangle itself

/// Radiance of every light at a hit, in three channels.
Vector3 shade(const RayScene& scene, const Membrane& membrane, const SurfaceHit& hit, const std::vector<Led>& leds) {
  std::array<Vector3, 3> v;
  for (std::size_t k = 0; k < 3; ++k)
    v[k] = membrane.positions.row(membrane.triangles(hit.triangle, static_cast<Eigen::Index>(k))).transpose();
  const Vector3 start = hit.point - kOffset * (v[1] - v[0]).cross(v[2] - v[0]).normalized();
  std::array<double, RayPacket::kSize> radiance{};
  RayPacket packet;
  for (int l = 0; l < RayPacket::kSize; ++l) packet.set(l, Vector3::Zero(), Vector3::UnitZ(), 0.0);
  packet.valid = 0;
  for (std::size_t l = 0; l < leds.size(); ++l) {
    const Vector3 way = leds[l].position_m - hit.point;
    const double distance = way.norm(), cosine = hit.inner_normal.dot(way) / distance;
    if (cosine <= 0.0) continue;
    radiance[l] = leds[l].intensity * cosine / (std::numbers::pi * distance * distance);
    packet.set(static_cast<int>(l), start, way / distance, distance);
  }
  const std::uint32_t blocked = packet.valid == 0 ? 0 : scene.blocked(packet);
  Vector3 sum = Vector3::Zero();
  for (std::size_t l = 0; l < leds.size(); ++l) {
    if ((blocked >> l & 1u) == 0) sum += radiance[l] * Vector3(leds[l].rgb[0], leds[l].rgb[1], leds[l].rgb[2]);
  }
  return sum;
}

}  // namespace

FloatImage flat_start_image(const Membrane& membrane, const Sensor& sensor) {
  assert(sensor.leds.size() <= RayPacket::kSize);
  const FlushDenormals flush;
  const RayScene scene(membrane.positions, membrane.triangles);
  const CameraModel camera(sensor.camera, sensor.stack, false);
  FloatImage image(sensor.camera.width_px, sensor.camera.height_px, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto seen = camera.ray(x + 0.5, y + 0.5);
      if (!seen) continue;
      const Ray ray{.origin = seen->origin, .direction = seen->direction};
      RayPacket packet;
      for (int l = 0; l < RayPacket::kSize; ++l) packet.set(l, ray.origin, ray.direction, 0.0);
      const int triangle = scene.first_hits(packet)[0];
      if (triangle < 0) continue;
      const SurfaceHit hit = surface_hit(membrane, triangle, ray);
      if (!hit.from_inside) continue;
      const Vector3 color = shade(scene, membrane, hit, sensor.leds);
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(color[c]);
    }
  return image;
}

}  // namespace tacipc
