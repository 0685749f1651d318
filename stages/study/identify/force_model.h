// Predicts the force on a sensor from presses at a unit modulus.
#pragma once

#include <vector>

#include "common/sensor/sensor.h"
#include "stages/study/identify/node_grid.h"

namespace tacipc {

/// Parameters that need no press of their own: forces of a quasi-static press are proportional to the modulus, and a
/// compliant mount only makes the press less deep.
struct Mounting {
  double modulus_pa = 0.0;
  double compliance_mm_per_n = 0.0;        // compliance along z
  double shear_compliance_mm_per_n = 0.0;  // compliance along x and y
};

/// Normal force at a holder travel of `depth_mm` beyond first contact with the undeformed front, N: F = E f(δ) with δ +
/// c F = depth. Zero for depths below 0.
/// \param force_per_pa f: force in N per Pa of modulus, over the depth in the gel, mm
double pressed_force_n(const Curve& force_per_pa, const Mounting& mounting, double depth_mm);

/// Tangential force at a subsequent sideways holder travel of `travel_mm`, N: T = E t(s) with s + c_s T = travel.
double sheared_force_n(const Curve& force_per_pa, const Mounting& mounting, double travel_mm);

/// Force of a viscoelastic gel at ascending `times_s` since the start of a press, N. The press takes `ramp_s` to
/// `depth_mm`, then holds: F = E f(δ) + Σ hᵢ, hᵢ' = (gᵢ/g∞) (E f(δ))' − hᵢ/τᵢ. This is exact if the contact does not
/// shrink and every material point relaxes alike [Lee and Radok 1960]. Time steps are at most a fortieth of the ramp
/// and a twentieth of the time since its start; within a step (E f)' is constant.
std::vector<double> relaxing_force_n(const Curve& force_per_pa, const Mounting& mounting,
                                     const std::vector<Relaxation>& relaxation, double depth_mm, double ramp_s,
                                     const std::vector<double>& times_s);

}  // namespace tacipc
