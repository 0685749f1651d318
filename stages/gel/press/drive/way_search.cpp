#include "stages/gel/press/drive/way_search.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

// Fingers without inertia that touch close at most by this factor farther than in their last step: a gel in light
// contact does not yet show its stiffness. Other fingers exceed a displacement that was too short at most by this
// factor.
constexpr double kGrowth = 2.0;
constexpr int kMostTries = 8;       // largest number of attempts per time step
constexpr double kTooStiff = 0.1;   // factor on a stiffness that proved too large
constexpr double kInnerPart = 0.1;  // fraction of a bracket by which the next attempt keeps away from its ends

}  // namespace

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
    // Moves up to the object, then little by little, because its stiffness is not known yet.
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
    // After a first, short displacement, the change since the last time step may also be due to time.
    stiffness_n_m_ = more_n / further_m;
    measured_ = tries_ > 0;
  } else if (tries_ > 0 && std::abs(further_m) * stiffness_n_m_ > 2.0 * kMeasurablePart * scale_n()) {
    // A displacement that changes nothing means that the assumed stiffness was too large.
    stiffness_n_m_ *= kTooStiff;
    measured_ = true;
  }
  ++tries_;
  noted_m_ = into_m;
  noted_way_m_ = way_m_;
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

bool WaySearch::stands() const { return balanced() || at_its_limit() || tries_ >= kMostTries; }

double WaySearch::imbalance() const {
  if (at_its_limit() && !balanced()) return 0.0;
  return std::abs(off_n_) / std::max(scale_n(), kTouches_n);
}

void WaySearch::correct(double object_ahead_m) {
  const double total = inertia_n_m_ + stiffness_n_m_;
  // If there is no resistance, it moves as far as allowed.
  double next = total > 0.0 ? way_m_ + (stiffness_n_m_ * object_ahead_m - off_n_) / total : most_m_;
  next = std::min(next, way_m_ + kGrowth * std::max(std::abs(way_m_), kFirstTouch_m));
  object_moves_ = object_moves_ || object_ahead_m != 0.0;
  if (!object_moves_ && std::isfinite(low_.way_m) && std::isfinite(high_.way_m)) {
    // Contact stiffens: a tangent from below overshoots, and a chord falls short.
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

double PairSearch::shift_of_object(double pull_n) const {
  double force = pull_n, stiffness = object_n_m_;
  for (const std::size_t side : {0, 1}) {
    const double own = sides_[side].stiffness_n_m(), all = own + sides_[side].inertia_n_m();
    if (own == 0.0) continue;
    force -= (side == 0 ? 1.0 : -1.0) * own * sides_[side].off_n() / all;
    stiffness += own * sides_[side].inertia_n_m() / all;
  }
  return force / stiffness;
}

void PairSearch::expect(double pull_n) {
  if (!coupled_) return;
  const double shift_m = shift_of_object(pull_n);
  sides_[0].expect(shift_m);
  sides_[1].expect(-shift_m);
}

void PairSearch::note(const Ways& grips_n, double object_m) {
  if (!coupled_) object_m = 0.0;
  sides_[0].note(grips_n[0], object_m);
  sides_[1].note(grips_n[1], -object_m);
}

void PairSearch::correct() {
  const double shift_m = coupled_ ? shift_of_object(0.0) : 0.0;
  sides_[0].correct(shift_m);
  sides_[1].correct(-shift_m);
}

}  // namespace tacipc
