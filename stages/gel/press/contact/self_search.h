// Broad phase of the gel with itself.
#pragma once

#include <vector>

#include "stages/gel/press/contact/bvh.h"
#include "stages/gel/press/contact/contact_mesh.h"
#include "stages/gel/press/contact/contact_pair.h"
#include "stages/gel/press/contact/open_face.h"

namespace tacipc {

/// Finds pairs of two primitives of the gel that share no vertex. Neighbours are always near each other, so a pair
/// counts only from min(d̂, half its distance at rest) on. A search finds some more pairs than needed, and its result is
/// kept while every vertex stays within a margin of the end of the step that was searched.
class SelfSearch {
 public:
  explicit SelfSearch(const ContactMesh& mesh);

  /// Appends every pair that comes nearer than that while the vertices move straight from `x` to `x + p`, and some
  /// more; which and in which order depends only on the arguments since forget().
  void pairs(const Positions& x, const Positions& p, double d_hat_m, std::vector<ContactPair>& out);

  /// Appends every pair with a vertex whose `reach_m` (one per vertex) is not zero that comes nearer than that while
  /// each vertex stays within its reach of its place, and some more. \pre each is on its path of the last call of
  /// pairs() or as far off it as its reach exceeds how far it goes
  void around(const std::vector<double>& reach_m, const Positions& x, double d_hat_m,
              std::vector<ContactPair>& out) const;

  void forget() { d_hat_m_ = -1.0; }
  int num_searches() const { return num_searches_; }

 private:
  /// Primitives of one part of the surface, by their numbers in the whole, with trees around them.
  struct Part {
    std::vector<int> vertices, edges, triangles;
    Bvh vertex_tree, edge_tree, triangle_tree;
  };
  Part part_of(bool face) const;
  void fit(Part& part, const std::vector<Box>& boxes, double margin, const OpenFace::Places* within = nullptr) const;
  void search(const Positions& x, const Positions& p, double d_hat_m);

  const ContactMesh& mesh_;
  OpenFace open_face_;
  Part face_, others_;             // primitives all of whose vertices are on the face, and all others
  Positions end_;                  // of the step that was searched
  std::vector<ContactPair> near_;  // pairs found, and how near each counts
  std::vector<double> reach_m_;
  Part face_at_risk_;          // the face again, its boxes empty where it is not at risk
  OpenFace::Places searched_;  // of the face with itself
  double d_hat_m_ = -1.0;
  int num_searches_ = 0;
};

}  // namespace tacipc
