// Bounding-volume tree over triangles, for distance and box queries.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Returns the squared distance from a point to a closed triangle, m². Triangles of no area count as their edges.
double squared_distance_to_triangle(const Vector3& point, const Vector3& a, const Vector3& b, const Vector3& c);

/// Tree over a mesh, which must outlive it. Queries may run in several threads.
class TriangleTree {
 public:
  /// \pre the mesh has a triangle.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// Returns the squared distance from a point to the nearest triangle, m²; exact up to rounding.
  double squared_distance(const Vector3& point) const;

  /// Returns whether a triangle is within a squared distance of a point, as squared_distance() would find, but stops at
  /// the first.
  /// \param face face to test first (initially any); on return, the face that was found
  bool within(const Vector3& point, double squared, int& face) const;

  /// Calls visit(face) for each face whose box touches `box`, in an order that the mesh determines.
  template <typename Visit>
  void overlaps(const Eigen::AlignedBox3d& box, Visit&& visit) const {
    for (int n = 0; n < static_cast<int>(nodes_.size());) {
      const Node& node = nodes_[n];
      if (!touches(node.box, box)) {
        n = node.next;
        continue;
      }
      for (int i = node.first; i < node.last; ++i)
        if (touches(box_of(faces_[i]), box)) visit(faces_[i]);
      ++n;
    }
  }

  /// Returns the bounding box of a face.
  Eigen::AlignedBox3d box_of(int face) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int next;         // node after this subtree
    int first, last;  // faces of a leaf; an inner node has none
  };

  static bool touches(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) {
    return (a.min().array() <= b.max().array()).all() && (b.min().array() <= a.max().array()).all();
  }
  void build(const std::vector<Eigen::AlignedBox3d>& boxes, int first, int last);
  bool reaches(int node, const Vector3& point, double squared, int& face) const;
  double squared_distance(const Vector3& point, int face) const;
  void nearest(int node, const Vector3& point, double& best) const;

  const TriangleMesh& mesh_;
  std::vector<Node> nodes_;
  std::vector<int> faces_;  // faces in leaf order
};

}  // namespace tacipc
