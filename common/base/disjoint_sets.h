// Union–find: disjoint sets of the numbers 0 … n − 1.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace tacipc {

/// Disjoint sets; each number begins in a set of its own.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int size() const { return static_cast<int>(parent_.size()); }

  /// Returns the smallest member of v's set.
  int root(int v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }

  /// Joins two sets.
  /// \return false if both numbers were in one set already
  bool join(int a, int b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
    return low != high;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace tacipc
