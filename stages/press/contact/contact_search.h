// Broad phase: which pairs of primitives may come near each other, now or during a step.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stages/press/contact/bvh.h"
#include "stages/press/contact/contact_mesh.h"
#include "stages/press/contact/distance.h"

namespace tacipc {

/// Two primitives by their four vertices: point, triangle corners; or the ends of two edges.
struct ContactPair {
  enum class Kind : std::uint8_t { point_triangle, edge_edge };
  Kind kind;
  std::array<int, 4> vertices;
  double weight = 1.0;  // of its energy (pair_counting.h)
};

/// The four points of a pair.
FourPoints gather(const Positions& x, const ContactPair& pair);

/// Closest feature of a pair.
ClosestFeature closest_feature(const ContactPair& pair, const FourPoints& x);

/// Finds pairs gel–object and gel–gel (never two primitives that share a vertex). The trees are built once and
/// refitted.
class ContactSearch {
 public:
  explicit ContactSearch(const ContactMesh& mesh);

  /// Every pair that comes within `radius_m` while the vertices move straight from `x` to `x + p`, and some more; in an
  /// order that depends on nothing but the arguments.
  std::vector<ContactPair> pairs(const Positions& x, const Positions& p, double radius_m);

 private:
  const ContactMesh& mesh_;
  std::vector<Box> gel_vertex_boxes_, gel_edge_boxes_, gel_triangle_boxes_;
  std::vector<Box> object_vertex_boxes_, object_edge_boxes_, object_triangle_boxes_;
  Bvh gel_edges_, gel_triangles_, object_vertices_, object_edges_, object_triangles_;
};

/// Smallest distance over the pairs, or `none` without pairs.
double smallest_distance(const std::vector<ContactPair>& pairs, const Positions& x, double none);

}  // namespace tacipc
