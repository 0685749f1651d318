// Broad phase between gel and object.
#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "stages/press/contact/bvh.h"
#include "stages/press/contact/contact_mesh.h"
#include "stages/press/contact/contact_pair.h"

namespace tacipc {

/// Finds pairs of a vertex, edge or triangle of the gel and a triangle, edge or vertex of the object.
///
/// Everything is seen from the object: what it drags along stands still. Each primitive of the gel keeps the object's
/// primitives that were near when it was last looked at, with their distance d₀ then. Once it has gone δ and the object
/// (turning) δ′ since, none of these is nearer than d₀ − δ − δ′, and nothing else is nearer than what was looked for;
/// only what has gone too far is looked at again.
class ObjectSearch {
 public:
  explicit ObjectSearch(const ContactMesh& mesh);

  /// Appends every pair that comes within `radius_m` while the vertices move straight from `x` to `x + p`, and some
  /// more; what and in which order depends on the arguments since forget() only.
  void pairs(const Positions& x, const Positions& p, double radius_m, std::vector<ContactPair>& out);

  /// Appends every pair with a vertex of the gel that `moves` (one flag per vertex) that is within `radius_m` at x, and
  /// some more. \pre the object is where the last call of pairs() saw it come by
  void around(const std::vector<bool>& moves, const Positions& x, double radius_m, std::vector<ContactPair>& out) const;

  /// Everything is looked at again in the next call.
  void forget() { radius_m_ = -1.0; }

  /// How often a primitive was looked at.
  std::int64_t num_looks() const { return num_looks_; }

 private:
  /// One of the object's primitives, and how far away it was.
  struct Near {
    int other;
    float distance_m;
  };
  /// Primitives of the gel with `Vertices` vertices each.
  template <int Vertices>
  struct Watched {
    std::vector<std::array<Vector3, Vertices>> seen_at;  // relative to the object
    std::vector<double> room_m;                          // how far it may go until it must be looked at again
    std::vector<std::vector<Near>> near;
    void resize(std::size_t count);
    void forget();
  };
  /// Where things are in one call, relative to the object's first vertex.
  struct Moment {
    Positions start, end;  // the gel's rows at x and at x + p, the object's where the trees have it
    double radius_m;
    double turned_m;  // how far any of the object's vertices is from there, at most
  };
  void place_object(const Positions& start);
  template <int Vertices, typename Primitives, typename PairOf>
  void watch(const Primitives& gel, const Bvh& object, const Moment& moment, PairOf&& pair_of, Watched<Vertices>& all,
             std::vector<ContactPair>& out);

  const ContactMesh& mesh_;
  Positions object_at_;  // relative to its first vertex, as the trees have it
  Bvh vertices_, edges_, triangles_;
  Watched<1> gel_vertices_;
  Watched<2> gel_edges_;
  Watched<3> gel_triangles_;
  double radius_m_ = -1.0, turned_m_ = 0.0;
  std::atomic<std::int64_t> num_looks_ = 0;
};

}  // namespace tacipc
