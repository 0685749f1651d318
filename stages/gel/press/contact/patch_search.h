// Contact pairs of a few moving gel vertices while all others are fixed.
#pragma once

#include <vector>

#include "stages/gel/press/contact/contact_search.h"

namespace tacipc {

/// Searches pairs once up to a reach of each vertex, and again for vertices that leave their reach. Among the pairs
/// found, only those count that come near within the travel of their vertices: most vertices move much less than a few
/// that snap over an edge.
class PatchSearch {
 public:
  /// Searches the pairs for the step p from x, with some reserve.
  /// \pre the vertices are gel vertices; objects are where the last call of ContactSearch::pairs() had them
  PatchSearch(ContactSearch& search, const std::vector<int>& vertices, int num_gel_vertices, const Positions& x,
              const Positions& p, double within_m, double longest_reach_m);

  /// Largest fraction of the step p from x, at most 1, that keeps every vertex within its reach. Searches again if the
  /// known reach allows less than 1.
  double part_within_reach(const Positions& x, const Positions& p);

  /// Extends pairs() to x and the straight path to it.
  /// \return false if pairs() covers them already
  /// \pre every vertex is within its reach
  bool extend_to(const Positions& x);

  /// Every pair with one of the vertices that comes within `within_m` since its vertices were searched, or a superset.
  /// Pairs within the gel count up to half of their distance at rest at most.
  const std::vector<ContactPair>& pairs() const { return pairs_; }

 private:
  /// Searches the pairs of some vertices again, for the step p from x with some reserve.
  void search_around(const std::vector<int>& some, const Positions& x, const Positions& p);
  double part_within_known_reach(const Positions& x, const Positions& p) const;

  ContactSearch& search_;
  const std::vector<int>& vertices_;
  int num_gel_vertices_;
  double within_m_, longest_reach_m_;
  Positions searched_at_;                   // position at which the pairs of each vertex were searched
  std::vector<double> reach_m_, travel_m_;  // per vertex of the mesh, measured from searched_at_
  std::vector<ContactPair> in_reach_, pairs_;
  std::vector<double> needed_m_;  // per pair in in_reach_: travel of a vertex from which on the pair counts
};

}  // namespace tacipc
