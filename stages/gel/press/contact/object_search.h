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
/// Positions are relative to the object, so that what it drags along stands still. Each primitive of the gel keeps the
/// object's primitives that were near when it was last searched, with their distance d₀ then. Once it has moved by δ
/// and the object (rotating) by δ′ since, none of these is nearer than d₀ − δ − δ′, and no other nearer than the search
/// went; only primitives that have moved too far are searched again.
class ObjectSearch {
 public:
  /// \param object one of the mesh's
  ObjectSearch(const ContactMesh& mesh, const ObjectPart& object);

  /// Appends every pair that comes within `within_m` while the vertices move straight from `x` to `x + p`, and some
  /// more; which and in which order depends only on the arguments since forget().
  void pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out);

  /// Appends every pair with a `wanted` vertex of the gel that comes within `within_m` while each vertex of the gel
  /// stays within its `reach_m` of its place, and some more. (One number of each per vertex.) \pre the object is on the
  /// path of the last call of pairs()
  void around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x, double within_m,
              std::vector<ContactPair>& out) const;

  /// The next call searches for every primitive.
  void forget() { within_m_.reset(); }

  /// Searches for a single primitive so far.
  std::int64_t num_searches() const { return num_searches_; }

 private:
  /// One of the object's primitives, and how far away it was.
  struct Near {
    int other;
    float distance_m;
  };
  /// Primitives of the gel with `Vertices` vertices each.
  template <int Vertices>
  struct Tracked {
    std::vector<std::array<Vector3, Vertices>> searched_at;  // relative to the object
    std::vector<double> margin_m;                            // how far it may move before it must be searched again
    std::vector<std::vector<Near>> near;
    void resize(std::size_t count);
    void forget();
  };
  /// What one call is about.
  struct Moment {
    const Positions &x, &p;
    /// Relative to the object's first vertex: the gel's rows at x and at x + p, the object's where the trees have it.
    Positions start, end;
    double within_m;
    double object_moved_m;  // largest distance of one of the object's vertices from there
  };
  void place_object(const Positions& start);
  template <int Vertices, typename Primitives, typename PairOf>
  void track(const Primitives& gel, const Bvh& object, const Moment& moment, PairOf&& pair_of, Tracked<Vertices>& all,
             std::vector<ContactPair>& out);

  const ContactMesh& mesh_;
  const ObjectPart& object_;
  Positions object_at_;  // relative to its first vertex, as the trees have it
  Bvh vertices_, edges_, triangles_;
  Tracked<1> gel_vertices_;
  Tracked<2> gel_edges_;
  Tracked<3> gel_triangles_;
  std::optional<double> within_m_;  // of the last call; absent: the next one searches for every primitive
  double object_moved_m_ = 0.0;
  std::atomic<std::int64_t> num_searches_ = 0;
};

}  // namespace tacipc
