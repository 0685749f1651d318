// Broad phase between gels and one object.
#pragma once

#include <array>
#include <atomic>
#include <optional>
#include <vector>

#include "stages/gel/press/contact/bvh.h"
#include "stages/gel/press/contact/contact_mesh.h"
#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Finds pairs of a vertex, edge or triangle of the gel and a triangle, edge or vertex of the object.
///
/// Positions are relative to the object, so that gel that moves with the object does not move. Each primitive of the
/// gel keeps the object's primitives that were near in its last search, with their distances d₀ at that time. Let it
/// have moved by δ since, and the object (rotating) by δ′. Then none of these is nearer than d₀ − δ − δ′, and all
/// others are beyond the range of the search minus δ and δ′. Only primitives that have moved too far are searched
/// again.
class ObjectSearch {
 public:
  /// \param object one of the mesh's objects
  ObjectSearch(const ContactMesh& mesh, const ObjectPart& object);

  /// Appends every pair that comes within `within_m` while the vertices move straight from `x` to `x + p`, or a
  /// superset. The pairs and their order depend only on the arguments since forget().
  void pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out);

  /// Appends every pair with a `wanted` gel vertex that comes within `within_m` while each gel vertex stays within its
  /// `reach_m` of its position in `x`, or a superset.
  /// \param wanted, reach_m one number per vertex
  /// \pre the object is on the path of the last call of pairs()
  void around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x, double within_m,
              std::vector<ContactPair>& out) const;

  /// Discards earlier results: the next call searches for every primitive.
  void forget() { within_m_.reset(); }

  /// Number of searches for a single primitive so far.
  std::int64_t num_searches() const { return num_searches_; }

 private:
  /// A primitive of the object, and its distance at the last search.
  struct Near {
    int other;
    float distance_m;
  };
  /// Primitives of the gel with `Vertices` vertices each.
  template <int Vertices>
  struct Tracked {
    std::vector<std::array<Vector3, Vertices>> searched_at;  // relative to the object
    std::vector<double> margin_m;  // distance by which the primitive may move before it must be searched again
    std::vector<std::vector<Near>> near;
    void resize(std::size_t count);
    void forget();
  };
  /// Arguments of one call of pairs(), and positions relative to the object.
  struct Moment {
    const Positions &x, &p;
    /// Relative to the object's first vertex: gel rows at x and at x + p, and object rows as in the trees.
    Positions start, end;
    double within_m;
    double object_moved_m;  // largest distance of an object vertex from its position in the trees
  };
  void place_object(const Positions& start);
  template <int Vertices, typename Primitives, typename PairOf>
  void track(const Primitives& gel, const Bvh& object, const Moment& moment, PairOf&& pair_of, Tracked<Vertices>& all,
             std::vector<ContactPair>& out);

  const ContactMesh& mesh_;
  const ObjectPart& object_;
  Positions object_at_;  // object vertices relative to the first one, as in the trees
  Bvh vertices_, edges_, triangles_;
  Tracked<1> gel_vertices_;
  Tracked<2> gel_edges_;
  Tracked<3> gel_triangles_;
  std::optional<double> within_m_;  // distance of the last call; absent: the next call searches for every primitive
  double object_moved_m_ = 0.0;
  std::atomic<std::int64_t> num_searches_ = 0;
};

}  // namespace tacipc
