#include <algorithm>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "stages/image/render/render_config.h"

namespace tacipc {
namespace {

/// Normal deviates in a fixed order.
class Deviates {
 public:
  explicit Deviates(int seed) : seed_(static_cast<std::uint64_t>(seed)) {}
  double next(double deviation) { return deviation * random_normal(seed_, kStream, counter_++); }
  Vector3 next3(double deviation) {
    const double x = next(deviation), y = next(deviation);
    return {x, y, next(deviation)};
  }

 private:
  static constexpr std::uint64_t kStream = 3;
  std::uint64_t seed_;
  std::uint64_t counter_ = 0;
};

void perturb(Sensor& sensor, const Perturbation& by) {
  Deviates deviates(by.seed);
  // If light is refracted, nothing may enter the gel, however large the deviate.
  const double nearest = sensor.stack.refracts() ? sensor.stack.back_z_m() - 1e-5 : -1e-5;
  for (Led& led : sensor.leds) {
    const bool embedded = led.position_m.z() > nearest;  // an LED inside a layer keeps its height
    Vector3 moved = led.position_m + deviates.next3(by.led_position_m);
    moved.z() = embedded ? led.position_m.z() : std::min(moved.z(), nearest);
    led.position_m = moved;
    led.intensity *= std::max(0.0, 1.0 + deviates.next(by.led_intensity));
  }
  const Vector3 shift = deviates.next3(by.camera_position_m), turn = deviates.next3(by.camera_rotation_rad);
  sensor.camera.position_m += shift;
  sensor.camera.position_m.z() = std::min(sensor.camera.position_m.z(), nearest);
  if (sensor.camera.model == Camera::Model::rectified) {
    sensor.camera.rotation_rad.z() += turn.z();
  } else {
    sensor.camera.rotation_rad += turn;
  }
  const double factor = std::max(0.0, 1.0 + deviates.next(by.coating_albedo));
  for (double& albedo : sensor.coating.albedo) albedo = std::min(1.0, albedo * factor);
}

}  // namespace

Sensor varied(const Sensor& sensor, const Variant& variant, const std::optional<Sensor>& other) {
  Sensor out = sensor;
  if (other) {
    out = *other;
    out.gel = sensor.gel;
    out.material = sensor.material;
    out.markers = sensor.markers;
  }
  if (out.light_field && (!variant.lights.empty() || variant.coating_albedo))
    throw DataError("variant {}: a light_field has neither light groups nor a coating to change", variant.name);
  if (variant.perturbation) perturb(out, *variant.perturbation);
  for (const Variant::Light& light : variant.lights) {
    int found = 0;
    for (Led& led : out.leds) {
      if (led.group != light.group) continue;
      led.rgb = light.rgb;
      ++found;
    }
    if (found == 0) throw DataError("variant {}: the sensor has no light group {}", variant.name, light.group);
  }
  if (variant.coating_albedo) out.coating.albedo = *variant.coating_albedo;
  if (variant.reference_image) out.reference_image = variant.reference_image;
  return out;
}

}  // namespace tacipc
