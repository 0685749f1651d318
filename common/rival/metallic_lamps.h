// Light model of the simulator TACTO [Wang2022]: point lights over a grey metallic surface.
#pragma once

#include <array>
#include <vector>

#include "common/base/types.h"
#include "common/base/value.h"
#include "common/config/config.h"

namespace tacipc {

/// A point light.
struct MetallicLamp {
  Vector3 position_m = Vector3::Zero();  // frame S
  std::array<double, 3> rgb{};  // colour times intensity as in TACTO's settings; the renderer divides it by 255
};

/// Contents of a file `metallic_lamps: {change_factor, lamps: [{position_mm, rgb}]}`, which `calibrate` can also write.
struct MetallicLamps {
  double change_factor = 0.0;  // factor of the rendered change (with minus without object) that is added to the
                               // photograph: 0.5 as published
  std::vector<MetallicLamp> lamps;

  static MetallicLamps read(ConfigReader& in);
  Value to_value() const;
};

/// Returns the light of a point light of rgb 1 on a point of unit normal n (towards the camera), before the display's
/// curve: nl/d² [(1 − F) c_d/π + F G D/(4 nl nv + 0.001)] / 255 with n·l and n·v clamped to 0.001 … 1, Schlick's F from
/// f0, G with k = (ρ + 1)²/8, D with α = ρ²; base 0.3, metallic 0.2, ρ = 0.8, so f0 = 0.092, c_d = 0.2304. No shadow.
/// Lengths in m.
double metallic_light(const Vector3& point, const Vector3& normal, const Vector3& camera, const Vector3& lamp);

/// Returns the 8-bit value 255 clamp(light, 0, 1)^(1/2.2), not rounded.
double metallic_code(double light);

}  // namespace tacipc
