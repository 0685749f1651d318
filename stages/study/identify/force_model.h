// Forces that a sensor shows when something is pressed into it, from what presses at a unit modulus say.
#pragma once

#include <vector>

#include "common/sensor/sensor.h"
#include "stages/study/identify/node_grid.h"

namespace tacipc {

/// What the fast press does not need to be run for: forces of a quasi-static press are proportional to the modulus, and
/// a mount that gives way only makes the press less deep.
struct Mounting {
  double modulus_pa = 0.0;
  double compliance_mm_per_n = 0.0;        // along z
  double shear_compliance_mm_per_n = 0.0;  // across
};

/// Force, N, where the holder has gone `depth_mm` beyond the undeformed front: F = E f(δ) with δ + c F = depth.
/// `force_per_pa`: f, N per Pa of modulus, over the depth in the gel, mm. Zero for depths below 0.
double pressed_force_n(const Curve& force_per_pa, const Mounting& mounting, double depth_mm);

/// Tangential force, N, where the holder has then gone `travel_mm` aside: T = E t(s) with s + c_s T = travel.
double sheared_force_n(const Curve& force_per_pa, const Mounting& mounting, double travel_mm);

/// Force, N, at ascending `times_s` from the start of a press that takes `ramp_s` to `depth_mm`, then holds, of a gel
/// whose stress relaxes: F = E f(δ) + Σ hᵢ, hᵢ' = (gᵢ/g∞) (E f(δ))' − hᵢ/τᵢ, which is exact where the contact does not
/// shrink and every material point relaxes alike [Lee and Radok 1960]. Steps of at most a fortieth of the ramp and of a
/// twentieth of the time since its start; in a step (E f)' is constant.
std::vector<double> relaxing_force_n(const Curve& force_per_pa, const Mounting& mounting,
                                     const std::vector<Relaxation>& relaxation, double depth_mm, double ramp_s,
                                     const std::vector<double>& times_s);

}  // namespace tacipc
