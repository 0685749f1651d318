#include "common/rival/metallic_lamps.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tacipc {

MetallicLamps MetallicLamps::read(ConfigReader& in) {
  MetallicLamps out;
  ConfigReader section = in.section("metallic_lamps");
  out.change_factor = section.number("change_factor", Range::positive());
  for (ConfigReader& item : section.one_or_more_sections("lamps")) {
    MetallicLamp lamp{.position_m = 1e-3 * item.vector3("position_mm")};
    const auto rgb = item.numbers("rgb", 3, Range::non_negative());
    std::ranges::copy(rgb, lamp.rgb.begin());
    out.lamps.push_back(lamp);
  }
  return out;
}

Value MetallicLamps::to_value() const {
  Value::List list;
  for (const MetallicLamp& lamp : lamps)
    list.emplace_back(Value::Map{
        {"position_mm", Value::List{1e3 * lamp.position_m.x(), 1e3 * lamp.position_m.y(), 1e3 * lamp.position_m.z()}},
        {"rgb", Value::List{lamp.rgb[0], lamp.rgb[1], lamp.rgb[2]}}});
  return Value::Map{{"metallic_lamps", Value::Map{{"change_factor", change_factor}, {"lamps", std::move(list)}}}};
}

double metallic_light(const Vector3& point, const Vector3& normal, const Vector3& camera, const Vector3& lamp) {
  constexpr double kBase = 0.3, kMetallic = 0.2, kRoughness = 0.8, kDielectric = 0.04;
  constexpr double kReflectance = kDielectric * (1.0 - kMetallic) + kBase * kMetallic;  // f0
  constexpr double kDiffuse = kBase * (1.0 - kDielectric) * (1.0 - kMetallic);          // c_d
  constexpr double kShadowing = (kRoughness + 1.0) * (kRoughness + 1.0) / 8.0;          // k
  constexpr double kAlphaSquared = kRoughness * kRoughness * kRoughness * kRoughness;   // α², α = ρ²
  constexpr double kWholeNumberColors = 255.0;  // the renderer takes whole numbers as 8-bit values
  const Vector3 way = lamp - point;
  const double squared = way.squaredNorm();
  const Vector3 l = way / std::sqrt(squared), v = (camera - point).normalized(), h = (l + v).normalized();
  const double nl = std::clamp(normal.dot(l), 0.001, 1.0), nv = std::clamp(std::abs(normal.dot(v)), 0.001, 1.0);
  const double nh = std::clamp(normal.dot(h), 0.0, 1.0), vh = std::clamp(v.dot(h), 0.0, 1.0);
  const double fresnel = kReflectance + (1.0 - kReflectance) * std::pow(1.0 - vh, 5.0);
  const double geometry = nl / (nl * (1.0 - kShadowing) + kShadowing) * nv / (nv * (1.0 - kShadowing) + kShadowing);
  const double lobe = nh * nh * (kAlphaSquared - 1.0) + 1.0;
  const double distribution = kAlphaSquared / (std::numbers::pi * lobe * lobe);
  const double reflected =
      (1.0 - fresnel) * kDiffuse / std::numbers::pi + fresnel * geometry * distribution / (4.0 * nl * nv + 0.001);
  return nl * reflected / squared / kWholeNumberColors;
}

double metallic_code(double light) { return 255.0 * std::pow(std::clamp(light, 0.0, 1.0), 1.0 / 2.2); }

}  // namespace tacipc
