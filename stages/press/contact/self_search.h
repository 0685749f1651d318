// Broad phase of the gel with itself.
#pragma once

#include <vector>

#include "stages/press/contact/bvh.h"
#include "stages/press/contact/contact_mesh.h"
#include "stages/press/contact/contact_pair.h"
#include "stages/press/contact/open_face.h"

namespace tacipc {

/// Finds pairs of two primitives of the gel that share no vertex. Neighbours are near each other for ever, so a pair
/// counts only from min(radius, half its distance at rest) on. What a search found is kept with some room around it,
/// for as long as everything stays that near the end of the way that was searched.
class SelfSearch {
 public:
  explicit SelfSearch(const ContactMesh& mesh);

  /// Appends every pair that comes nearer than that while the vertices move straight from `x` to `x + p`, and some
  /// more; what and in which order depends on the arguments since forget() only.
  void pairs(const Positions& x, const Positions& p, double radius_m, std::vector<ContactPair>& out);

  /// Appends every pair with a vertex that `moves` (one flag per vertex) that comes nearer than that while each of
  /// those vertices stays within `reach_m` of its place in each coordinate, and some more. \pre all others are where
  /// the last call of pairs() saw them come by
  void around(const std::vector<bool>& moves, const Positions& x, double radius_m, double reach_m,
              std::vector<ContactPair>& out) const;

  void forget() { radius_m_ = -1.0; }
  int num_searches() const { return num_searches_; }

 private:
  /// Primitives of one part of the surface, by their numbers in the whole, with trees around them.
  struct Part {
    std::vector<int> vertices, edges, triangles;
    Bvh vertex_tree, edge_tree, triangle_tree;
  };
  Part part_of(bool face) const;
  void fit(Part& part, const std::vector<Box>& boxes, double margin) const;
  void search(const Positions& x, const Positions& p, double radius_m, bool face_is_open);

  const ContactMesh& mesh_;
  OpenFace open_face_;
  Part face_, others_;             // primitives all of whose vertices are on the face, and all others
  Positions end_;                  // of the way that was searched
  std::vector<ContactPair> near_;  // pairs found, and how near each counts
  std::vector<double> reach_m_;
  bool left_out_face_ = false;
  double radius_m_ = -1.0;
  int num_searches_ = 0;
};

}  // namespace tacipc
