// How much of the contact Hessian's positive stand-in the next Newton step leans on.
#pragma once

#include <algorithm>

namespace tacipc {

/// As little as positive definiteness lets it be: less after each step that went well, and boldly as long as that
/// works; more where the Hessian turned out not to be positive definite, or a step was too long for the energy.
class Blend {
 public:
  /// All of the stand-in, always, unless adaptive.
  explicit Blend(bool adaptive = true) : adaptive_(adaptive) {}

  double share() const { return share_; }

  /// A step with this share was found at once, or only after trying less.
  void found(bool at_once) {
    if (!adaptive_) return;
    boldness_ = std::clamp(at_once ? kBolder * boldness_ : kShyer * boldness_, kLeastBoldness, kMostBoldness);
    share_ = share_ > kFirst ? share_ / boldness_ : 0.0;
  }
  /// The Hessian with this share is not positive definite.
  void failed() { share_ = share_ == 0.0 ? kFirst : std::min(1.0, kGrowth * share_); }
  /// The energy fell only after a step with share `used` was shortened.
  void shortened(double used) { share_ = std::min(1.0, std::max(kAfterShortening, 4.0 * used)); }

 private:
  static constexpr double kFirst = 0.1;
  static constexpr double kGrowth = 6.0;
  static constexpr double kAfterShortening = 0.1;
  static constexpr double kLeastBoldness = 1.5;
  static constexpr double kMostBoldness = 8.0;
  static constexpr double kBolder = 1.4;
  static constexpr double kShyer = 0.5;
  bool adaptive_;
  double share_ = 1.0, boldness_ = kMostBoldness;
};

}  // namespace tacipc
