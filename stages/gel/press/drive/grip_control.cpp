#include "stages/gel/press/drive/grip_control.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

// Limits of a stiffness measured between two time steps, as factors on the last one. The upper limit applies to steps
// shorter than the first touch, because other causes also change the grip force.
constexpr double kSofterMost = 0.5, kStifferMost = 4.0;
constexpr double kMeasurable_m = 1e-7;  // a shorter step measures no stiffness
constexpr double kArrived_m = 1e-9;     // tolerance of a prescribed displacement

}  // namespace

bool GripControl::touches() const { return last_grip_n >= kTouches_n; }

bool GripControl::arrived(const DriveInertia& inertia) const {
  if (by_way) return std::abs(wanted_closed_m - closed_m) <= kArrived_m;
  // Force amplitude of an oscillation with this velocity.
  const double swing_n = std::abs(velocity_m_s) * std::sqrt(inertia.mass_kg * stiffness_n_m);
  return std::max(std::abs(last_grip_n - wanted_n), swing_n) <= kGripTolerance * wanted_n;
}

void GripControl::grip(double force_n) {
  by_way = false;
  wanted_n = force_n;
}

void GripControl::go_to(double to_m) {
  by_way = true;
  wanted_closed_m = to_m;
}

void GripControl::measure(double h_s, double step_m, double grip_n, std::optional<double> found_n_m) {
  const double touched = grip_n - last_grip_n;
  if (found_n_m) {
    stiffness_n_m = *found_n_m;
  } else if (stiffness_n_m == 0.0) {
    // First touch: it began somewhere within the step.
    if (grip_n > kTouches_n) stiffness_n_m = grip_n / std::max(std::abs(step_m), kFirstTouch_m);
  } else if (std::abs(step_m) > kMeasurable_m && touched / step_m > 0.0 &&
             std::abs(touched) > kMeasurablePart * grip_n) {
    double now = std::max(touched / step_m, kSofterMost * stiffness_n_m);
    if (std::abs(step_m) < kFirstTouch_m) now = std::min(now, kStifferMost * stiffness_n_m);
    stiffness_n_m = now;
  }
  // A later force-controlled phase starts from the present grip force.
  if (by_way) wanted_n = grip_n;
  velocity_m_s = step_m / h_s;
  last_step_m = step_m;
  last_grip_n = grip_n;
}

}  // namespace tacipc
