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
/// refitted. What they found is kept with some room around it, and looked through while everything moves within that
/// room; the answer is the same as that of a new search.
class ContactSearch {
 public:
  explicit ContactSearch(const ContactMesh& mesh);

  /// Every pair that comes within `radius_m` while the vertices move straight from `x` to `x + p`, and some more; in an
  /// order that depends on nothing but the arguments.
  std::vector<ContactPair> pairs(const Positions& x, const Positions& p, double radius_m);

  /// Every pair with a vertex that `moves` (one flag per vertex) that comes within `radius_m` while each of those
  /// vertices stays within `reach_m` of its place in each coordinate, and some more. \pre they are where the last call
  /// of pairs() saw them come by, all others where it saw them
  std::vector<ContactPair> pairs_around(const std::vector<bool>& moves, const Positions& x, double radius_m,
                                        double reach_m) const;

  /// The next call searches, whatever is known: what is found in a time step must not hang on steps before.
  void forget() { searched_radius_m_ = -1.0; }

  /// How often the trees were searched.
  int num_searches() const { return num_searches_; }

 private:
  /// Boxes of everything that one call looks at.
  struct Boxes {
    std::vector<Box> gel_vertices, gel_edges, gel_triangles, object_vertices, object_edges, object_triangles;
  };
  /// Primitives of two kinds whose boxes, grown by the room, touch.
  struct Near {
    int first, second;
  };
  void fill(const Positions& x, const Positions& p, double radius_m);
  bool within_room(double radius_m) const;
  void search(double radius_m);

  const ContactMesh& mesh_;
  Boxes now_, searched_;
  double searched_radius_m_ = -1.0;
  std::vector<Near> vertex_object_triangle_, vertex_gel_triangle_, triangle_object_vertex_, edge_object_edge_,
      edge_gel_edge_;
  Bvh gel_vertices_, gel_edges_, gel_triangles_, object_vertices_, object_edges_, object_triangles_;
  int num_searches_ = 0;
};

/// Smallest distance over the pairs, or `none` without pairs.
double smallest_distance(const std::vector<ContactPair>& pairs, const Positions& x, double none);

}  // namespace tacipc
