// A sensor, and files of identifications of it, for tests that press nothing.
#pragma once

#include <fmt/format.h>

#include <string>

#include "common/benchmark/identify_spec.h"
#include "common/sensor/sensor.h"
#include "tests/config_text.h"

namespace tacipc {

/// What a sensor file needs besides gel and material.
inline const std::string kMadeUpOptics = R"(coating: {albedo: [0.5, 0.5, 0.5]}
leds: {emission: lambertian, size_mm: 0, list: [{rgb_linear: [1, 1, 1], intensity: 1, position_mm: [0, 5, -12]}]}
camera: {model: rectified, position_mm: [0, 0, -20], width_px: 160, height_px: 120, window_mm: [16, 12]}
markers: {rows: 5, columns: 5, pitch_mm: 1}
response: {mean_level: 0.4, curve: srgb}
noise: {full_well_e: 5000, read_e: 4}
)";

inline Sensor made_up_sensor() {
  return config_from_text<Sensor>(
      R"(name: made_up
gel: {outline: disc, radius_mm: 15, thickness_mm: 4}
material: {law: neo_hookean, density_kg_m3: 1000, youngs_modulus_pa: 2.0e+5, poissons_ratio: 0.47}
)" + kMadeUpOptics,
      "sensor");
}

inline IdentifySpec made_up_spec(const std::string& parameters, const std::string& measurements) {
  return config_from_text<IdentifySpec>("title: t\nsensor: s\nmesh: m\npress: p\ndraws: 2000\nparameters:\n" +
                                            parameters + "measurements:\n" + measurements,
                                        "identify");
}

/// A measurement of a ball pressed up to 2 mm; `more` are further keys.
inline std::string made_up_press(const std::string& name, double radius_mm, const std::string& more = "") {
  return fmt::format(
      "  - {{name: {}, kind: press, ball: {{radius_mm: {}, edge_mm: 0.2}}, file: f, columns: {{depth_mm: d, force_n: "
      "f}}, "
      "sigma: {{relative: 0.01, force_n: 0.003}}, simulate: {{to_mm: 2, press_frames: 20}}{}}}\n",
      name, radius_mm, more);
}

}  // namespace tacipc
