// Tree of axis-aligned boxes for the solver's broad phase; it is refitted as the boxes move.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "common/base/simd.h"

namespace tacipc {

using Box = Eigen::AlignedBox3d;

/// Binary tree, split at the median centre along the widest axis; the same boxes always give the same tree. Nodes are
/// stored depth first, each with the index after its subtree, so that a query needs neither stack nor memory. Boxes in
/// single precision, rounded outwards, exclude most nodes and items, four numbers at a time; the others are compared
/// exactly.
class Bvh {
 public:
  /// \pre no box is empty (min ≤ max in each coordinate) and all corners are finite
  explicit Bvh(std::span<const Box> boxes);

  /// Moves the boxes but keeps the tree. \pre the number of boxes is unchanged; else as for the constructor
  void refit(std::span<const Box> boxes);

  /// Calls visit(i) once for each box i that touches `box` (shared faces count), in an order fixed by the tree.
  /// Thread-safe.
  template <typename Visit>
  void query(const Box& box, Visit&& visit) const {
    const int num_nodes = static_cast<int>(nodes_.size());
    const RoughBox rough(box);
    for (int n = 0; n < num_nodes;) {
      const Node& node = nodes_[n];
      if (!touches(node.box, rough)) {
        n = node.next;
        continue;
      }
      if (is_leaf(n)) for_each_in_leaf(node, rough, box, 0, [&](int i) { visit(item_[i]); });
      ++n;
    }
  }

  /// Pairs of nodes of this tree and another (or this tree again) below which all overlaps lie, in an order fixed by
  /// the trees. They divide the work for parallel calls of overlaps().
  using NodePairs = std::vector<std::array<int, 2>>;
  NodePairs split(const Bvh& other) const;
  /// Calls visit(i, j) once for each box i of this tree that touches box j of the other tree, below pairs first … last
  /// − 1 of split(other), in an order fixed by the trees. For a tree with itself, each pair of boxes is visited once,
  /// in either order, and no box is paired with itself.
  template <typename Visit>
  void overlaps(const Bvh& other, const NodePairs& pairs, std::size_t first, std::size_t last, Visit&& visit) const {
    for (std::size_t i = first; i < last; ++i) descend(other, pairs[i][0], pairs[i][1], visit);
  }

 private:
  static constexpr int kLeafSize = 4;

  /// Single-precision box that encloses a box; the fourth number is the same in all.
  struct RoughBox {
    FloatQuad low = {}, high = {};
    RoughBox() = default;
    explicit RoughBox(const Box& box);
  };
  struct Node {
    RoughBox box;
    int next;         // index of the first node after this subtree
    int first, last;  // items of a leaf; empty range for an inner node
    int leaf;         // index among the leaves
  };
  /// Boxes of a leaf's items, one per lane; lanes without an item touch nothing.
  struct LeafBoxes {
    std::array<FloatQuad, 3> low, high;
  };

  static bool touches(const Box& a, const Box& b) {
    return a.min().x() <= b.max().x() && b.min().x() <= a.max().x() && a.min().y() <= b.max().y() &&
           b.min().y() <= a.max().y() && a.min().z() <= b.max().z() && b.min().z() <= a.max().z();
  }
  static bool touches(const RoughBox& a, const RoughBox& b) { return all_of((a.low <= b.high) & (b.low <= a.high)); }

  bool is_leaf(int node) const { return nodes_[node].first != nodes_[node].last; }

  /// Calls visit(i) for the items of a leaf, starting with number `from`, that touch the box.
  template <typename Visit>
  void for_each_in_leaf(const Node& leaf, const RoughBox& rough, const Box& box, int from, Visit&& visit) const {
    const LeafBoxes& items = leaves_[static_cast<std::size_t>(leaf.leaf)];
    IntQuad touching = IntQuad{-1, -1, -1, -1};
    for (int c = 0; c < 3; ++c) {
      const FloatQuad low = FloatQuad{} + rough.low[c], high = FloatQuad{} + rough.high[c];
      touching &= (items.low[c] <= high) & (low <= items.high[c]);
    }
    if (none_of(touching)) return;
    for (int i = leaf.first + from; i < leaf.last; ++i) {
      if (touching[i - leaf.first] && touches(box_of_item_[i], box)) visit(i);
    }
  }

  /// Visits the children of a pair of nodes: those of the larger node, or of both for a node with itself.
  template <typename Step>
  void divide(const Bvh& other, int a, int b, Step&& step) const {
    if (this == &other && a == b) {
      const int left = a + 1, right = nodes_[left].next;
      step(left, left), step(left, right), step(right, right);
    } else if (other.is_leaf(b) || (!is_leaf(a) && nodes_[a].next - a >= other.nodes_[b].next - b)) {
      const int left = a + 1, right = nodes_[left].next;
      step(left, b), step(right, b);
    } else {
      const int left = b + 1, right = other.nodes_[left].next;
      step(a, left), step(a, right);
    }
  }
  template <typename Visit>
  void descend(const Bvh& other, int a, int b, Visit&& visit) const {
    if (!touches(nodes_[a].box, other.nodes_[b].box)) return;
    if (!is_leaf(a) || !other.is_leaf(b)) {
      divide(other, a, b, [&](int c, int d) { descend(other, c, d, visit); });
      return;
    }
    const bool self = this == &other && a == b;
    for (int i = nodes_[a].first; i < nodes_[a].last; ++i) {
      other.for_each_in_leaf(other.nodes_[b], rough_box_of_item_[i], box_of_item_[i],
                             self ? i - nodes_[a].first + 1 : 0, [&](int j) { visit(item_[i], other.item_[j]); });
    }
  }

  void build(std::span<const Box> boxes, int first, int last);
  void fit();

  std::vector<Node> nodes_;
  std::vector<LeafBoxes> leaves_;
  std::vector<int> item_;         // box index of each leaf item
  std::vector<Box> box_of_item_;  // box of each leaf item
  std::vector<RoughBox> rough_box_of_item_;
};

}  // namespace tacipc
