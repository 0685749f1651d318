#include "stages/render/trace.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "common/error.h"
#include "stages/render/camera_rays.h"
#include "stages/render/light_path.h"
#include "stages/render/surface_hit.h"

namespace tacipc {
namespace {

struct RowCounts {
  std::int64_t nudged = 0;
  std::int64_t outside = 0;
  std::optional<std::array<int, 2>> fallen_pixel;
};

/// Adds to `light` (one entry per LED) what reaches a hit.
void add_light(const RayScene& scene, const SurfaceHit& hit, const std::vector<LightSample>& samples,
               std::vector<double>& light) {
  constexpr int kPacket = RayScene::kPacket;
  std::array<Vector3, kPacket> ends;
  std::array<double, kPacket> radiance;
  std::array<int, kPacket> led;
  int waiting = 0;
  const auto flush = [&] {
    const std::uint32_t blocked = scene.blocked(hit.shadow_origin, ends, waiting);
    for (int i = 0; i < waiting; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if ((blocked >> i & 1u) == 0) light[static_cast<std::size_t>(led[k])] += radiance[k];
    }
    waiting = 0;
  };
  for (const LightSample& sample : samples) {
    const Incidence incidence = light_path(hit.point, sample);
    const double cosine = hit.inner_normal.dot(incidence.direction);
    if (cosine <= 0.0 || incidence.irradiance <= 0.0) continue;
    const auto k = static_cast<std::size_t>(waiting++);
    ends[k] = incidence.path_end;
    radiance[k] = incidence.irradiance * cosine * std::numbers::inv_pi;
    led[k] = sample.led;
    if (waiting == kPacket) flush();
  }
  if (waiting > 0) flush();
}

class RowTracer {
 public:
  RowTracer(const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings)
      : membrane_(membrane),
        camera_(sensor.camera),
        rays_(sensor.camera),
        scene_(membrane.positions, membrane.triangles),
        lights_(light_samples(sensor.leds, settings.led_samples)),
        subpixels_(settings.subpixels),
        num_leds_(sensor.leds.size()) {}

  RowCounts trace_row(int row, TraceResult& out) const {
    const FlushDenormals flush;
    RowCounts counts;
    std::vector<double> light(num_leds_);
    for (int column = 0; column < camera_.width_px; ++column) {
      light.assign(num_leds_, 0.0);
      double depth = 0.0, indentation = 0.0;
      Vector3 normal = Vector3::Zero();
      int hits = 0;
      for (int j = 0; j < subpixels_; ++j) {
        for (int i = 0; i < subpixels_; ++i) {
          const Ray ray = rays_.ray(column + (i + 0.5) / subpixels_, row + (j + 0.5) / subpixels_);
          const auto hit = find_hit(ray, counts);
          if (!hit) {
            if (inside_outline(membrane_, ray)) {
              if (!counts.fallen_pixel) counts.fallen_pixel = {column, row};
            } else {
              ++counts.outside;
            }
            continue;
          }
          ++hits;
          depth += hit->point.z() - camera_.position_m.z();
          indentation += hit->indentation;
          normal -= hit->inner_normal;
          if (hit->from_inside) add_light(scene_, *hit, lights_, light);
        }
      }
      const double rays_per_pixel = subpixels_ * subpixels_;
      for (std::size_t led = 0; led < num_leds_; ++led) {
        out.basis.at(column, row, static_cast<int>(led)) = static_cast<float>(light[led] / rays_per_pixel);
      }
      if (hits == 0) continue;
      out.depth.at(column, row, 0) = static_cast<float>(depth / hits);
      out.indentation.at(column, row, 0) = static_cast<float>(indentation / hits);
      normal.normalize();
      for (int c = 0; c < 3; ++c) out.normal.at(column, row, c) = static_cast<float>(normal[c]);
    }
    return counts;
  }

 private:
  std::optional<SurfaceHit> find_hit(const Ray& ray, RowCounts& counts) const {
    auto triangle = scene_.first_hit(ray);
    if (!triangle) {
      for (const Vector3& nudge : {Vector3(1.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0)}) {
        const Ray beside{.origin = ray.origin, .direction = (ray.direction + 1e-6 * nudge).normalized()};
        triangle = scene_.first_hit(beside);
        if (triangle) break;
      }
      if (!triangle) return std::nullopt;
      ++counts.nudged;
    }
    return surface_hit(membrane_, *triangle, ray);
  }

  const Membrane& membrane_;
  const Camera& camera_;
  CameraRays rays_;
  RayScene scene_;
  std::vector<LightSample> lights_;
  int subpixels_;
  std::size_t num_leds_;
};

}  // namespace

TraceResult trace(const Membrane& membrane, const Sensor& sensor, const TraceSettings& settings) {
  const int width = sensor.camera.width_px, height = sensor.camera.height_px;
  constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
  TraceResult out{.basis = FloatImage(width, height, static_cast<int>(sensor.leds.size())),
                  .depth = FloatImage(width, height, 1, kNothing),
                  .normal = FloatImage(width, height, 3, kNothing),
                  .indentation = FloatImage(width, height, 1, kNothing)};
  const RowTracer tracer(membrane, sensor, settings);
  std::vector<RowCounts> rows(static_cast<std::size_t>(height));
  tbb::parallel_for(0, height, [&](int row) { rows[static_cast<std::size_t>(row)] = tracer.trace_row(row, out); });
  out.rays = std::int64_t{width} * height * settings.subpixels * settings.subpixels;
  for (const RowCounts& row : rows) {
    if (row.fallen_pixel) {
      throw DataError("a camera ray slips through the front face at pixel ({}, {}), even after a nudge",
                      (*row.fallen_pixel)[0], (*row.fallen_pixel)[1]);
    }
    out.nudged_rays += row.nudged;
    out.outside_rays += row.outside;
  }
  return out;
}

FloatImage color_image(const FloatImage& basis, const Sensor& sensor) {
  FloatImage image(basis.width, basis.height, 3);
  const std::size_t num_leds = sensor.leds.size();
  tbb::parallel_for(0, basis.height, [&](int y) {
    for (int x = 0; x < basis.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (std::size_t led = 0; led < num_leds; ++led)
          sum += sensor.leds[led].rgb[c] * basis.at(x, y, static_cast<int>(led));
        image.at(x, y, static_cast<int>(c)) =
            static_cast<float>(sensor.coating_albedo[c] * sum + sensor.ambient_rgb[c]);
      }
    }
  });
  return image;
}

}  // namespace tacipc
