#include "stages/gel/press/grip_control.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

constexpr double kFirstTouch_m = 2e-5;  // a finger that touches for the first time closes by this in the next step
// A measured stiffness counts as at least the first times the last one, and at most the second where the step was
// shorter than the first touch: it measures what else has changed the grip, too.
constexpr double kSofterMost = 0.5, kStifferMost = 4.0;
// Fingers that touch go at most so many times as far as in their last step: a gel that is touched by little more at
// first tells nothing of how stiff it will be.
constexpr double kGrowth = 2.0;
constexpr double kMeasurable_m = 1e-6;   // a shorter step measures no stiffness
constexpr double kGripTolerance = 0.02;  // of the force asked for, when fingers count as closed
constexpr double kArrived_m = 1e-9;      // from where they are wanted

}  // namespace

bool GripControl::touches() const { return last_grip_n >= kTouches_n; }

bool GripControl::arrived() const {
  return by_way ? std::abs(wanted_closed_m - closed_m) <= kArrived_m
                : std::abs(last_grip_n - wanted_n) <= kGripTolerance * wanted_n;
}

void GripControl::grip(double force_n) {
  by_way = false;
  wanted_n = force_n;
}

void GripControl::go_to(double to_m) {
  by_way = true;
  wanted_closed_m = to_m;
}

double GripControl::closing_step(double most_m, double reach_m, const Gap& gap) const {
  if (by_way) return std::clamp(wanted_closed_m - closed_m, -most_m, most_m);
  if (!touches()) {
    // Up to the object, and then little by little: how stiff it is is not known yet.
    return std::clamp(gap(most_m + reach_m) - reach_m, std::min(kFirstTouch_m, most_m), most_m);
  }
  const double bound = std::min(most_m, kGrowth * std::max(std::abs(last_step_m), kFirstTouch_m));
  return std::clamp((wanted_n - last_grip_n) / stiffness_n_m, -bound, bound);
}

void GripControl::measure(double step_m, double grip_n) {
  const double touched = grip_n - last_grip_n;
  if (stiffness_n_m == 0.0) {
    // The first touch: what it took, from somewhere within the step.
    if (grip_n > kTouches_n) stiffness_n_m = grip_n / std::max(std::abs(step_m), kFirstTouch_m);
  } else if (std::abs(step_m) > kMeasurable_m && touched / step_m > 0.0) {
    double now = std::max(touched / step_m, kSofterMost * stiffness_n_m);
    if (std::abs(step_m) < kFirstTouch_m) now = std::min(now, kStifferMost * stiffness_n_m);
    stiffness_n_m = now;
  } else if (std::abs(step_m) <= kMeasurable_m && !by_way && std::abs(grip_n - wanted_n) > kGripTolerance * wanted_n) {
    // Steps that are too short to measure, and do not reach what is wanted, are those of too stiff a guess.
    stiffness_n_m *= kSofterMost;
  }
  // Who grips next goes on from the grip there is.
  if (by_way) wanted_n = grip_n;
  last_step_m = step_m;
  last_grip_n = grip_n;
}

}  // namespace tacipc
