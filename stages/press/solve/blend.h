// How much of the contact Hessian's positive stand-in the next Newton step leans on, and where.
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace tacipc {

/// A share in [0, 1] for every vertex of the gel, as little as positive definiteness lets it be: less after each step
/// that was found, and boldly where that works; more about those vertices where the Hessian turned out not to be
/// positive definite, or where a step was too long for the energy. What snaps over an edge of the object does so in a
/// few places: all others go on with the exact Hessian.
class Blend {
 public:
  /// All of the stand-in everywhere, always, unless adaptive.
  explicit Blend(int num_gel_vertices, bool adaptive = true)
      : Blend(std::vector<double>(static_cast<std::size_t>(num_gel_vertices), 1.0), adaptive) {}
  explicit Blend(std::vector<double> shares, bool adaptive = true)
      : adaptive_(adaptive),
        share_(std::move(shares)),
        used_(share_),
        boldness_(share_.size(), kMostBoldness),
        failed_(share_.size(), false) {}

  double share(int vertex) const { return share_[static_cast<std::size_t>(vertex)]; }
  /// Of a contact between these vertices: the largest of the gel's among them.
  double share(std::span<const int> stencil) const {
    double largest = 0.0;
    for (const int v : stencil) {
      if (v < static_cast<int>(share_.size())) largest = std::max(largest, share(v));
    }
    return largest;
  }
  double largest() const { return share_.empty() ? 0.0 : *std::max_element(share_.begin(), share_.end()); }

  /// A step was found with these shares.
  void found() {
    if (!adaptive_) return;
    used_ = share_;
    for (std::size_t v = 0; v < share_.size(); ++v) {
      boldness_[v] = std::clamp(boldness_[v] * (failed_[v] ? kShyer : kBolder), kLeastBoldness, kMostBoldness);
      share_[v] = share_[v] > kFirst ? share_[v] / boldness_[v] : 0.0;
      failed_[v] = false;
    }
  }
  /// The Hessian with these shares is not positive definite about a vertex; false if it leans on all of the stand-in
  /// there already.
  bool failed(int vertex) {
    double& share = share_[static_cast<std::size_t>(vertex)];
    failed_[static_cast<std::size_t>(vertex)] = true;
    if (share == 1.0) return false;
    share = share == 0.0 ? kFirst : std::min(1.0, kGrowth * share);
    return true;
  }
  /// The energy fell only after the step that was found last was shortened, and `vertex` went far in it.
  void shortened(int vertex) {
    const auto v = static_cast<std::size_t>(vertex);
    if (adaptive_) share_[v] = std::min(1.0, std::max(kAfterShortening, kAgain * used_[v]));
  }

 private:
  static constexpr double kFirst = 0.1;
  static constexpr double kGrowth = 6.0;
  static constexpr double kAfterShortening = 0.1;
  static constexpr double kAgain = 4.0;
  static constexpr double kLeastBoldness = 1.5;
  static constexpr double kMostBoldness = 4.0;
  static constexpr double kBolder = 1.4;
  static constexpr double kShyer = 0.5;
  bool adaptive_;
  std::vector<double> share_, used_, boldness_;
  std::vector<bool> failed_;
};

}  // namespace tacipc
