// The solver's broad phase: a tree over axis-aligned boxes that is refitted as the boxes move.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

namespace tacipc {

using Box = Eigen::AlignedBox3d;

/// Binary tree, split at the median centre along the widest axis; the same boxes always give the same tree.
/// Nodes lie depth first, each knowing where the next subtree starts, so that a query needs neither stack nor memory.
class Bvh {
 public:
  /// \pre no box is empty (min ≤ max in each coordinate) and all corners are finite.
  explicit Bvh(std::span<const Box> boxes);

  int num_boxes() const { return static_cast<int>(box_of_item_.size()); }

  /// Moves the boxes but keeps the tree. \pre boxes.size() == num_boxes()
  void refit(std::span<const Box> boxes);

  /// Calls visit(i) once for each box i that touches `box` (shared faces count), in an order fixed by the tree.
  /// Safe to call from several threads at once.
  template <typename Visit>
  void query(const Box& box, Visit&& visit) const {
    const int num_nodes = static_cast<int>(nodes_.size());
    for (int n = 0; n < num_nodes;) {
      const Node& node = nodes_[n];
      if (!touches(node.box, box)) {
        n = node.next;
        continue;
      }
      for (int i = node.first; i < node.last; ++i)
        if (touches(box_of_item_[i], box)) visit(item_[i]);
      ++n;
    }
  }

 private:
  struct Node {
    Box box;
    int next;         // first node after this subtree
    int first, last;  // items of a leaf; an inner node has none
  };

  static bool touches(const Box& a, const Box& b) {
    return a.min().x() <= b.max().x() && b.min().x() <= a.max().x() && a.min().y() <= b.max().y() &&
           b.min().y() <= a.max().y() && a.min().z() <= b.max().z() && b.min().z() <= a.max().z();
  }

  void build(std::span<const Box> boxes, int first, int last);
  void fit();

  std::vector<Node> nodes_;
  std::vector<int> item_;         // box index of each leaf item
  std::vector<Box> box_of_item_;  // its box, in leaf order
};

}  // namespace tacipc
