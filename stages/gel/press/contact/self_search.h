// Broad phase of a gel with itself.
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
/// counts only below min(`within_m`, half of its distance at rest). Pairs within the front face are searched where it
/// is at risk (open_face.h), separately from pairs with the gel's other surfaces. A search finds more pairs than
/// needed, and its result is reused while the vertices concerned stay within a margin of the end of the searched step.
class SelfSearch {
 public:
  explicit SelfSearch(const ContactMesh& mesh);

  /// Appends every pair that comes nearer than that while the vertices move straight from `x` to `x + p`, or a
  /// superset. The pairs and their order depend only on the arguments since forget().
  void pairs(const Positions& x, const Positions& p, double within_m, std::vector<ContactPair>& out);

  /// Appends every pair with a `wanted` vertex that comes nearer than that while each vertex stays within its `reach_m`
  /// of its position in `x`, or a superset.
  /// \param wanted, reach_m one number per vertex
  /// \pre wanted vertices have a reach above zero
  void around(const std::vector<char>& wanted, const std::vector<double>& reach_m, const Positions& x, double within_m,
              std::vector<ContactPair>& out);

  /// Discards earlier results: the next call repeats the search.
  void forget() {
    within_m_.reset();
    fitted_.resize(0, 3);
  }
  /// Number of calls of pairs() that had to search.
  int num_searches() const { return num_searches_; }

 private:
  /// Primitives of one part of the surface, by their numbers in the whole, with trees around them.
  struct Part {
    std::vector<int> vertices, edges, triangles;
    Bvh vertex_tree, edge_tree, triangle_tree;
  };
  /// Result of a search while the vertices moved to `end`. It is valid while each of `vertices` is within its margin of
  /// its position there.
  struct Found {
    std::vector<int> vertices;
    std::vector<double> margin_m;  // one per vertex of the mesh
    Positions end;
    std::vector<ContactPair> pairs;
    std::vector<double> reach_m;  // distance below which each pair counts

    bool holds(const Positions& x, const Positions& p) const;
  };
  /// A query for candidates, in parts that can run in parallel.
  using Query = std::function<void(std::size_t part, std::vector<ContactPair>& candidates)>;

  Part part_of(bool face) const;
  /// A part with some of the primitives, and trees around them.
  Part make_part(std::vector<int> vertices, std::vector<int> edges, std::vector<int> triangles,
                 const std::vector<Box>& boxes, double margin) const;
  void fit(Part& part, const std::vector<Box>& boxes, double margin) const;
  /// Boxes around the paths of some vertices and around the margins at the ends of the paths.
  std::vector<Box> boxes_of(const std::vector<int>& vertices, const Positions& x, const Positions& p,
                            const std::vector<double>& margin_m) const;
  Query vertices_and_triangles(const Part& a, const Part& b) const;
  Query edges(const Part& a, const Part& b) const;
  void search_face(const Positions& x, const Positions& p);
  void search_others(const Positions& x, const Positions& p);
  void find(const std::vector<Query>& queries, const Positions& x, const Positions& p, Found& out) const;

  const ContactMesh& mesh_;
  OpenFace open_face_;
  Part face_, others_;  // primitives with all vertices on the face, and all other primitives
  std::vector<OpenFace::Squares> squares_of_vertex_, squares_of_edge_,
      squares_of_triangle_;                 // squares of the face's primitives, in order
  double margin_m_ = 0.0;                   // margin, proportional to the mean edge
  std::vector<double> margin_of_others_m_;  // margins without the part that is proportional to the search distance

  std::optional<double> within_m_;  // distance of the last search; absent: no earlier result
  Found of_face_, of_others_;       // pairs within the face, and all other pairs
  OpenFace::Places searched_;       // points of the face that have been searched against the face
  Positions fitted_;  // positions to which around() has fitted the trees; empty if it was not the last to do so
  int num_searches_ = 0;
};

}  // namespace tacipc
