#include "stages/gel/press/contact/bvh.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace tacipc {

// A double differs from its nearest float by at most 6e-8 of itself; below the smallest normal float, by less than the
// constant.
Bvh::RoughBox::RoughBox(const Box& box) {
  for (int c = 0; c < 3; ++c) {
    low[c] = static_cast<float>(box.min()[c] - 1.2e-7 * std::abs(box.min()[c]) - 1e-37);
    high[c] = static_cast<float>(box.max()[c] + 1.2e-7 * std::abs(box.max()[c]) + 1e-37);
  }
}

Bvh::Bvh(std::span<const Box> boxes) : item_(boxes.size()), box_of_item_(boxes.size()) {
  std::iota(item_.begin(), item_.end(), 0);
  nodes_.reserve(boxes.size());
  if (!boxes.empty()) build(boxes, 0, static_cast<int>(boxes.size()));
  refit(boxes);
}

void Bvh::build(std::span<const Box> boxes, int first, int last) {
  const int self = static_cast<int>(nodes_.size());
  nodes_.push_back({.box = {}, .next = 0, .first = first, .last = last, .leaf = -1});
  if (last - first <= kLeafSize) {
    std::sort(item_.begin() + first, item_.begin() + last);
    nodes_[self].leaf = static_cast<int>(leaves_.size());
    leaves_.emplace_back();
  } else {
    Box centres;
    for (int i = first; i < last; ++i) centres.extend(boxes[item_[i]].center());
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    // Ties are broken by index, so that the division does not depend on the library's partition.
    std::nth_element(item_.begin() + first, item_.begin() + middle, item_.begin() + last, [&](int a, int b) {
      const double ca = boxes[a].min()[axis] + boxes[a].max()[axis];
      const double cb = boxes[b].min()[axis] + boxes[b].max()[axis];
      return ca != cb ? ca < cb : a < b;
    });
    nodes_[self].last = first;
    build(boxes, first, middle);
    build(boxes, middle, last);
  }
  nodes_[self].next = static_cast<int>(nodes_.size());
}

Bvh::NodePairs Bvh::split(const Bvh& other) const {
  constexpr std::size_t kMinPairs = 256;
  if (nodes_.empty() || other.nodes_.empty()) return {};
  NodePairs pairs{{0, 0}};
  for (bool divided = true; divided && pairs.size() < kMinPairs;) {
    divided = false;
    NodePairs finer;
    for (const auto& [a, b] : pairs) {
      if (!touches(nodes_[a].box, other.nodes_[b].box)) continue;
      if (is_leaf(a) && other.is_leaf(b)) {
        finer.push_back({a, b});
        continue;
      }
      divided = true;
      divide(other, a, b, [&](int c, int d) { finer.push_back({c, d}); });
    }
    pairs = std::move(finer);
  }
  return pairs;
}

void Bvh::refit(std::span<const Box> boxes) {
  assert(boxes.size() == item_.size());
  for (std::size_t i = 0; i < item_.size(); ++i) box_of_item_[i] = boxes[item_[i]];
  fit();
}

void Bvh::fit() {
  constexpr float kBeyond = std::numeric_limits<float>::infinity();
  rough_box_of_item_.resize(box_of_item_.size());
  for (std::size_t i = 0; i < box_of_item_.size(); ++i) rough_box_of_item_[i] = RoughBox(box_of_item_[i]);
  const auto extend = [](RoughBox& box, const RoughBox& by) {
    box.low = by.low < box.low ? by.low : box.low;
    box.high = by.high > box.high ? by.high : box.high;
  };
  // Children come after their parent, so a backward loop reaches them first.
  for (int n = static_cast<int>(nodes_.size()) - 1; n >= 0; --n) {
    Node& node = nodes_[n];
    node.box.low = FloatQuad{kBeyond, kBeyond, kBeyond, 0.0F};
    node.box.high = FloatQuad{-kBeyond, -kBeyond, -kBeyond, 0.0F};
    if (!is_leaf(n)) {
      extend(node.box, nodes_[n + 1].box);
      extend(node.box, nodes_[nodes_[n + 1].next].box);
      continue;
    }
    LeafBoxes& leaf = leaves_[static_cast<std::size_t>(node.leaf)];
    leaf.low.fill(FloatQuad{} + kBeyond);
    leaf.high.fill(FloatQuad{} - kBeyond);
    for (int i = node.first; i < node.last; ++i) {
      const RoughBox& box = rough_box_of_item_[i];
      extend(node.box, box);
      for (int c = 0; c < 3; ++c) {
        leaf.low[c][i - node.first] = box.low[c];
        leaf.high[c][i - node.first] = box.high[c];
      }
    }
  }
}

}  // namespace tacipc
