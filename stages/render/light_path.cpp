#include "stages/render/light_path.h"

#include <algorithm>
#include <cmath>

namespace tacipc {

std::vector<LightSample> light_samples(const std::vector<Led>& leds, int edge_samples) {
  std::vector<LightSample> samples;
  for (std::size_t i = 0; i < leds.size(); ++i) {
    const Led& led = leds[i];
    const bool point = led.size_m[0] == 0.0 && led.size_m[1] == 0.0;
    const int n = point ? 1 : edge_samples;
    Vector3 outwards = led.position_m - Vector3::UnitZ() * led.position_m.z();
    outwards -= led.normal * led.normal.dot(outwards);
    if (outwards.norm() < 1e-6 * led.position_m.norm()) outwards = led.normal.unitOrthogonal();
    const Vector3 first = outwards.normalized(), second = led.normal.cross(first);
    for (int a = 0; a < n; ++a) {
      for (int b = 0; b < n; ++b) {
        const double u = (a + 0.5) / n - 0.5, v = (b + 0.5) / n - 0.5;
        samples.push_back({.position_m = led.position_m + u * led.size_m[0] * first + v * led.size_m[1] * second,
                           .normal = led.normal,
                           .lambertian = led.lambertian,
                           .weight = 1.0 / (n * n),
                           .led = static_cast<int>(i)});
      }
    }
  }
  return samples;
}

Incidence light_path(const Vector3& point, const LightSample& sample) {
  const Vector3 to_light = sample.position_m - point;
  const double squared_distance = to_light.squaredNorm();
  const Vector3 direction = to_light / std::sqrt(squared_distance);
  const double emission = sample.lambertian ? std::max(0.0, -direction.dot(sample.normal)) : 1.0;
  return {
      .direction = direction, .path_end = sample.position_m, .irradiance = sample.weight * emission / squared_distance};
}

}  // namespace tacipc
