// Which share of the contact Hessian's PSD approximation the next Newton step takes, vertex by vertex.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace tacipc {

/// A share in [0, 1] for every vertex of the gel, and of objects where these touch each other: 0 the exact Hessian, 1
/// its PSD approximation; as small as positive definiteness allows. Shares fall after each Newton step that was found,
/// faster and faster while that works. They rise about those vertices where the Hessian turned out not to be positive
/// definite, or where the line search had to shorten a step. Vertices that snap over an edge of the object are few: all
/// others keep the exact Hessian.
class Blend {
 public:
  /// All shares are 1, and stay so unless adaptive.
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
  /// Of a contact between these vertices: the largest among them.
  double share(std::span<const int> stencil) const {
    double largest = 0.0;
    for (const int v : stencil) {
      if (has(v)) largest = std::max(largest, share(v));
    }
    return largest;
  }
  /// Whether the last step took any of the approximation about a vertex.
  bool approximated(int vertex) const { return last_used_[static_cast<std::size_t>(vertex)] > 0.0; }
  double largest() const { return share_.empty() ? 0.0 : *std::max_element(share_.begin(), share_.end()); }

  /// A step was found with these shares: the next one tries smaller ones.
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
  /// The Hessian with these shares is not positive definite about a vertex. False if the share there is 1 already.
  bool raise(int vertex) {
    double& share = share_[static_cast<std::size_t>(vertex)];
    raised_[static_cast<std::size_t>(vertex)] = true;
    if (share == 1.0) return false;
    share = share == 0.0 ? kSmallestShare : std::min(1.0, kRaiseFactor * share);
    return true;
  }
  /// Goes on about a vertex where another blend has got to.
  void take_over(int vertex, const Blend& other) {
    const auto v = static_cast<std::size_t>(vertex);
    share_[v] = other.share_[v];
    last_used_[v] = other.last_used_[v];
    divisor_[v] = other.divisor_[v];
    raised_[v] = other.raised_[v];
  }
  /// The line search had to shorten the last step, and `vertex` went far in it.
  void raise_after_shortening(int vertex) {
    const auto v = static_cast<std::size_t>(vertex);
    if (adaptive_) share_[v] = std::min(1.0, std::max(kShareAfterShortening, kShorteningFactor * last_used_[v]));
  }

 private:
  static constexpr double kSmallestShare = 0.1;  // but for zero
  static constexpr double kRaiseFactor = 10.0;   // of a share where the Hessian was not positive definite
  // After a shortened step: at least this, and so many times the share that it was found with.
  static constexpr double kShareAfterShortening = 0.1, kShorteningFactor = 4.0;
  // What a share is divided by after a step: it grows from step to step, and shrinks where the share had to be raised.
  static constexpr double kSmallestDivisor = 1.1, kLargestDivisor = 4.0;
  static constexpr double kDivisorFactor = 1.4, kDivisorFactorAfterRaise = 0.5;
  bool adaptive_;
  std::vector<double> share_, last_used_, divisor_;
  std::vector<bool> raised_;  // since the last step
};

}  // namespace tacipc
