// Sets of the numbers 0 … n − 1 that have no member in common.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace tacipc {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int size() const { return static_cast<int>(parent_.size()); }

  /// The least member of v's set.
  int root(int v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }

  /// False if the two were in one set before.
  bool join(int a, int b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
    return low != high;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace tacipc
