#include "stages/press/contact/bvh.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace tacipc {
namespace {

constexpr int kLeafSize = 4;

}  // namespace

Bvh::Bvh(std::span<const Box> boxes) : item_(boxes.size()), box_of_item_(boxes.size()) {
  std::iota(item_.begin(), item_.end(), 0);
  nodes_.reserve(boxes.size());
  if (!boxes.empty()) build(boxes, 0, static_cast<int>(boxes.size()));
  refit(boxes);
}

void Bvh::build(std::span<const Box> boxes, int first, int last) {
  const int self = static_cast<int>(nodes_.size());
  nodes_.push_back({.box = Box(), .next = 0, .first = first, .last = last});
  if (last - first <= kLeafSize) {
    std::sort(item_.begin() + first, item_.begin() + last);
  } else {
    Box centres;
    for (int i = first; i < last; ++i) centres.extend(boxes[item_[i]].center());
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const int middle = first + (last - first) / 2;
    // Ties are broken by index, so which boxes go left does not depend on the library's partition.
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

void Bvh::refit(std::span<const Box> boxes) {
  assert(boxes.size() == item_.size());
  for (std::size_t i = 0; i < item_.size(); ++i) box_of_item_[i] = boxes[item_[i]];
  fit();
}

void Bvh::fit() {
  // Children come after their parent, so going backwards meets them first.
  for (int n = static_cast<int>(nodes_.size()) - 1; n >= 0; --n) {
    Node& node = nodes_[n];
    node.box.setEmpty();
    for (int i = node.first; i < node.last; ++i) node.box.extend(box_of_item_[i]);
    for (int child = n + 1; node.first == node.last && child < node.next; child = nodes_[child].next)
      node.box.extend(nodes_[child].box);
  }
}

}  // namespace tacipc
