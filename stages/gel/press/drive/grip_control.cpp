#include "stages/gel/press/drive/grip_control.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

constexpr double kFirstTouch_m = 2e-5;  // a finger that touches for the first time closes by this in the next step
// A stiffness measured from one time step to the next counts as at least the first times the last one, and at most the
// second where the step was shorter than the first touch: it measures what else has changed the grip, too.
constexpr double kSofterMost = 0.5, kStifferMost = 4.0;
// Fingers without inertia that touch go at most so many times as far as in their last step: a gel that is touched by
// little more at first tells nothing of how stiff it will be. Nor do others go farther beyond a way that was too short.
constexpr double kGrowth = 2.0;
constexpr double kMeasurable_m = 1e-7;    // a shorter step measures no stiffness
constexpr double kGripTolerance = 0.02;   // of the force: what may be missing to a drive's balance, and to its rest
constexpr double kArrived_m = 1e-9;       // from where they are wanted
constexpr int kMostTries = 8;             // of a time step
constexpr double kMeasurablePart = 2e-3;  // of the force: a smaller change within a step may be the solver's tolerance
constexpr double kTooStiff = 0.1;         // times a stiffness by which it was not
constexpr double kInnerPart = 0.1;        // of a bracket: as far from its ends the next try is

}  // namespace

bool GripControl::touches() const { return last_grip_n >= kTouches_n; }

bool GripControl::arrived(const DriveInertia& inertia) const {
  if (by_way) return std::abs(wanted_closed_m - closed_m) <= kArrived_m;
  // A swing of this speed reaches so much more force.
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
    // The first touch: what it took, from somewhere within the step.
    if (grip_n > kTouches_n) stiffness_n_m = grip_n / std::max(std::abs(step_m), kFirstTouch_m);
  } else if (std::abs(step_m) > kMeasurable_m && touched / step_m > 0.0 &&
             std::abs(touched) > kMeasurablePart * grip_n) {
    double now = std::max(touched / step_m, kSofterMost * stiffness_n_m);
    if (std::abs(step_m) < kFirstTouch_m) now = std::min(now, kStifferMost * stiffness_n_m);
    stiffness_n_m = now;
  }
  // Who grips next goes on from the grip there is.
  if (by_way) wanted_n = grip_n;
  velocity_m_s = step_m / h_s;
  last_step_m = step_m;
  last_grip_n = grip_n;
}

WaySearch::WaySearch(const GripControl& drive, const DriveInertia& inertia, double h_s, double most_m, double reach_m,
                     const GripControl::Gap& gap)
    : wanted_n_(drive.wanted_n),
      inertia_n_m_(inertia.stiffness_n_m(h_s)),
      push_n_(inertia.mass_kg / h_s * drive.velocity_m_s + drive.wanted_n),
      grip_n_(drive.last_grip_n),
      stiffness_n_m_(drive.touches() ? drive.stiffness_n_m : 0.0),
      touches_(drive.touches()),
      least_m_(-most_m),
      most_m_(most_m) {
  off_n_ = grip_n_ - push_n_;
  if (touches_) {
    const double bound = kGrowth * std::max(std::abs(drive.last_step_m), kFirstTouch_m);
    if (inertia.none()) most_m_ = std::min(most_m, bound);
    way_m_ = std::clamp(-off_n_ / (inertia_n_m_ + stiffness_n_m_), inertia.none() ? -most_m_ : -most_m, most_m_);
  } else {
    if (off_n_ < 0.0) low_ = {0.0, off_n_};
    // Up to the object, and then little by little: how stiff it is is not known yet.
    way_m_ = std::clamp(gap(most_m + reach_m) - reach_m, std::min(kFirstTouch_m, most_m), most_m);
    if (inertia.none()) {
      most_m_ = way_m_;
    } else {
      way_m_ = std::max(std::min(way_m_, -off_n_ / inertia_n_m_), least_m_);
    }
  }
}

double WaySearch::scale_n() const { return std::max(wanted_n_, grip_n_); }

void WaySearch::note(double grip_n, double object_m) {
  const double into_m = way_m_ - object_m, further_m = into_m - noted_m_, more_n = grip_n - grip_n_;
  if (grip_n < kTouches_n) {
    if (!touches_) stiffness_n_m_ = 0.0;
  } else if (stiffness_n_m_ == 0.0) {
    stiffness_n_m_ = grip_n / std::max(std::abs(into_m), kFirstTouch_m);
  } else if ((tries_ > 0 || further_m >= kFirstTouch_m) && further_m * more_n > 0.0 &&
             std::abs(more_n) > kMeasurablePart * scale_n()) {
    // After a first, short way what has changed since the last time step may be due to time as well.
    stiffness_n_m_ = more_n / further_m;
    measured_ = tries_ > 0;
  } else if (tries_ > 0 && std::abs(further_m) * stiffness_n_m_ > 2.0 * kMeasurablePart * scale_n()) {
    // A way that changes nothing is that of too stiff a guess.
    stiffness_n_m_ *= kTooStiff;
    measured_ = true;
  }
  ++tries_;
  noted_m_ = into_m;
  grip_n_ = grip_n;
  off_n_ = inertia_n_m_ * way_m_ + grip_n - push_n_;
  if (off_n_ < 0.0 && way_m_ > low_.way_m) low_ = {way_m_, off_n_};
  if (off_n_ > 0.0 && way_m_ < high_.way_m) high_ = {way_m_, off_n_};
}

bool WaySearch::balanced() const { return std::abs(off_n_) <= kGripTolerance * scale_n(); }

std::optional<double> WaySearch::found_n_m() const {
  if (measured_ || (inertia_n_m_ == 0.0 && balanced() && touches_ && stiffness_n_m_ > 0.0)) return stiffness_n_m_;
  return std::nullopt;
}

bool WaySearch::stands() const {
  return balanced() || (off_n_ < 0.0 && way_m_ >= most_m_) || (off_n_ > 0.0 && way_m_ <= least_m_) ||
         tries_ >= kMostTries;
}

void WaySearch::correct(double object_ahead_m) {
  const double total = inertia_n_m_ + stiffness_n_m_;
  // Where neither resists it goes as far as it may.
  double next = total > 0.0 ? way_m_ + (stiffness_n_m_ * object_ahead_m - off_n_) / total : most_m_;
  next = std::min(next, way_m_ + kGrowth * std::max(std::abs(way_m_), kFirstTouch_m));
  object_moves_ = object_moves_ || object_ahead_m != 0.0;
  if (!object_moves_ && std::isfinite(low_.way_m) && std::isfinite(high_.way_m)) {
    // Contact stiffens: a tangent from below leads too far, and a chord not far enough.
    const double width = high_.way_m - low_.way_m, inner = kInnerPart * width;
    const double chord = low_.way_m - low_.off_n * width / (high_.off_n - low_.off_n);
    next =
        std::clamp(0.5 * (std::clamp(next, low_.way_m, high_.way_m) + chord), low_.way_m + inner, high_.way_m - inner);
  }
  way_m_ = std::clamp(next, least_m_, most_m_);
}

void WaySearch::expect(double object_ahead_m) {
  object_moves_ = true;
  if (touches_)
    way_m_ =
        std::clamp((stiffness_n_m_ * object_ahead_m - off_n_) / (inertia_n_m_ + stiffness_n_m_), least_m_, most_m_);
}

}  // namespace tacipc
