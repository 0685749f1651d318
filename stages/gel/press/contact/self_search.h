// Broad phase of the gel with itself.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "stages/gel/press/contact/bvh.h"
#include "stages/gel/press/contact/contact_mesh.h"
#include "stages/gel/press/contact/contact_pair.h"
#include "stages/gel/press/contact/open_face.h"

namespace tacipc {

/// Finds pairs of two primitives of the gel that share no vertex. Neighbours are always near each other, so a pair
/// counts only from min(`within_m`, half its distance at rest) on. Pairs of the face with itself are searched where it
/// is at risk, and apart from those with the gel's other surfaces. A search finds some more pairs than needed, and its
/// result is kept while the vertices in question stay within a margin of the end of the step that was searched.
class SelfSearch {
 public:
  explicit SelfSearch(const ContactMesh& mesh);

  /// Appends every pair that comes nearer than that while the vertices move straight from `x` to `x + p`, and some
  /// more; which and in which order depends only on the arguments since forget().
  void pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out);

  /// Appends every pair with a `wanted` vertex that comes nearer than that while each vertex stays within its `reach_m`
  /// of its place in `x`, and some more. (One number of each per vertex.) \pre wanted vertices have a reach above zero
  void around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x, double within_m,
              std::vector<ContactPair>& out);

  void forget() {
    within_m_.reset();
    fitted_.resize(0, 3);
  }
  /// Calls of pairs() that had to search.
  int num_searches() const { return num_searches_; }

 private:
  /// Primitives of one part of the surface, by their numbers in the whole, with trees around them.
  struct Part {
    std::vector<int> vertices, edges, triangles;
    Bvh vertex_tree, edge_tree, triangle_tree;
  };
  /// What was found while the vertices went to `end`; holds while each of `vertices` is within its margin of that.
  struct Found {
    std::vector<int> vertices;
    std::vector<double> margin_m;  // one per vertex of all
    Positions end;
    std::vector<ContactPair> pairs;
    std::vector<double> reach_m;  // how near each counts

    bool holds(const Positions& x, const Positions& p) const;
  };
  /// A query for candidates, in parts that can run at the same time.
  using Query = std::function<void(std::size_t part, std::vector<ContactPair>& candidates)>;

  Part part_of(bool face) const;
  /// A part with some of the primitives and trees around them.
  Part make_part(std::vector<int> vertices, std::vector<int> edges, std::vector<int> triangles,
                 const std::vector<Box>& boxes, double margin) const;
  void fit(Part& part, const std::vector<Box>& boxes, double margin) const;
  /// Boxes around the ways of some vertices, and around the margins at their ends.
  std::vector<Box> boxes_of(const std::vector<int>& vertices, const Positions& x, const Positions& p,
                            const std::vector<double>& margin_m) const;
  Query vertices_and_triangles(const Part& a, const Part& b) const;
  Query edges(const Part& a, const Part& b) const;
  void search_face(const Positions& x, const Positions& p);
  void search_others(const Positions& x, const Positions& p);
  void find(const std::vector<Query>& queries, const Positions& x, const Positions& p, Found& out) const;

  const ContactMesh& mesh_;
  OpenFace open_face_;
  Part face_, others_;  // primitives all of whose vertices are on the face, and all others
  std::vector<OpenFace::Squares> squares_of_vertex_, squares_of_edge_, squares_of_triangle_;  // of the face's, in order
  double margin_m_ = 0.0;                   // that goes with the mean edge
  std::vector<double> margin_of_others_m_;  // but for the part that goes with the search distance

  std::optional<double> within_m_;  // of the last search; absent: the next one starts anew
  Found of_face_, of_others_;       // pairs of the face with itself, and all others
  OpenFace::Places searched_;       // of the face with itself
  Positions fitted_;                // places that the trees fit, if around() fitted them last
  int num_searches_ = 0;
};

}  // namespace tacipc
