// Blend of the exact contact Hessian and its PSD approximation in the next Newton step, vertex by vertex.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace tacipc {

/// PSD shares in [0, 1] of every gel vertex, and of object vertices if objects touch each other: 0 the exact Hessian, 1
/// its PSD approximation. Shares are as small as positive definiteness allows. They fall after each Newton step, at a
/// growing rate while that succeeds. They rise at vertices where the Hessian is not positive definite, or where the
/// line search had to shorten a step. Only few vertices snap over an edge of the object at a time: all others keep the
/// exact Hessian.
class Blend {
 public:
  /// All shares are 1; they remain so if `adaptive` is false.
  explicit Blend(int num_vertices, bool adaptive = true)
      : Blend(std::vector<double>(static_cast<std::size_t>(num_vertices), 1.0), adaptive) {}
  explicit Blend(std::vector<double> shares, bool adaptive = true)
      : adaptive_(adaptive),
        share_(std::move(shares)),
        last_used_(share_),
        divisor_(share_.size(), kLargestDivisor),
        raised_(share_.size(), false) {}

  int size() const { return static_cast<int>(share_.size()); }
  bool has(int vertex) const { return vertex < size(); }
  double share(int vertex) const { return share_[static_cast<std::size_t>(vertex)]; }
  /// Share of a contact between these vertices: the largest share among them.
  double share(std::span<const int> stencil) const {
    double largest = 0.0;
    for (const int v : stencil) {
      if (has(v)) largest = std::max(largest, share(v));
    }
    return largest;
  }
  /// Whether the last step used any of the approximation at a vertex.
  bool approximated(int vertex) const { return last_used_[static_cast<std::size_t>(vertex)] > 0.0; }
  double largest() const { return share_.empty() ? 0.0 : *std::max_element(share_.begin(), share_.end()); }

  /// Lowers all shares after a step has been found with them.
  void lower() {
    if (!adaptive_) return;
    last_used_ = share_;
    for (std::size_t v = 0; v < share_.size(); ++v) {
      divisor_[v] = std::clamp(divisor_[v] * (raised_[v] ? kDivisorFactorAfterRaise : kDivisorFactor), kSmallestDivisor,
                               kLargestDivisor);
      share_[v] = share_[v] > kSmallestShare ? share_[v] / divisor_[v] : 0.0;
      raised_[v] = false;
    }
  }
  /// Raises the share of a vertex at which the Hessian is not positive definite.
  /// \return false if the share is 1 already
  bool raise(int vertex) {
    double& share = share_[static_cast<std::size_t>(vertex)];
    raised_[static_cast<std::size_t>(vertex)] = true;
    if (share == 1.0) return false;
    share = share == 0.0 ? kSmallestShare : std::min(1.0, kRaiseFactor * share);
    return true;
  }
  /// Copies the state of a vertex from another blend.
  void take_over(int vertex, const Blend& other) {
    const auto v = static_cast<std::size_t>(vertex);
    share_[v] = other.share_[v];
    last_used_[v] = other.last_used_[v];
    divisor_[v] = other.divisor_[v];
    raised_[v] = other.raised_[v];
  }
  /// Raises the share of a vertex that had a long step which the line search had to shorten.
  void raise_after_shortening(int vertex) {
    const auto v = static_cast<std::size_t>(vertex);
    if (adaptive_) share_[v] = std::min(1.0, std::max(kShareAfterShortening, kShorteningFactor * last_used_[v]));
  }

 private:
  static constexpr double kSmallestShare = 0.1;  // smallest share above zero
  static constexpr double kRaiseFactor = 10.0;   // factor on a share where the Hessian was not positive definite
  // After a shortened step: smallest share, and factor on the share with which the step was found.
  static constexpr double kShareAfterShortening = 0.1, kShorteningFactor = 4.0;
  // Divisor of a share after a step: it grows from step to step, and shrinks at a vertex whose share had to be raised.
  static constexpr double kSmallestDivisor = 1.1, kLargestDivisor = 4.0;
  static constexpr double kDivisorFactor = 1.4, kDivisorFactorAfterRaise = 0.5;
  bool adaptive_;
  std::vector<double> share_, last_used_, divisor_;
  std::vector<bool> raised_;  // whether a share was raised since the last step
};

}  // namespace tacipc
