// Which pairs some vertices of the gel can come near to while all others stand still.
#pragma once

#include <vector>

#include "stages/gel/press/contact/contact_search.h"

namespace tacipc {

/// Pairs are searched up to a reach of each vertex, again for those that get out of it. Of those found only the ones
/// count that come near within a travel of each vertex: most vertices go much less far than a few that snap over an
/// edge.
class PatchSearch {
 public:
  /// For the step p from x and more. \pre the vertices are of the gel; objects are where the last call of
  /// ContactSearch::pairs() had them
  PatchSearch(ContactSearch& search, const std::vector<int>& vertices, int num_gel_vertices, const Positions& x,
              const Positions& p, double within_m, double longest_reach_m);

  /// Largest part of the step p from x, at most 1, by which every vertex stays within its reach. Where that is not 1 it
  /// is after another search.
  double part_within_reach(const Positions& x, const Positions& p);

  /// Lets pairs() hold at x, too, and on the straight way there. False where they do already.
  /// \pre every vertex is within its reach
  bool extend_to(const Positions& x);

  /// Every pair with one of the vertices that comes within `within_m` (of the gel with itself within half its distance
  /// at rest at most) on its way since its vertices were searched, and some more.
  const std::vector<ContactPair>& pairs() const { return pairs_; }

 private:
  /// Searches anew from x for the pairs of some vertices, for the step p and more.
  void search_around(const std::vector<int>& some, const Positions& x, const Positions& p);
  double part_within_known_reach(const Positions& x, const Positions& p) const;

  ContactSearch& search_;
  const std::vector<int>& vertices_;
  int num_gel_vertices_;
  double within_m_, longest_reach_m_;
  Positions searched_at_;                   // where the pairs of each vertex were searched
  std::vector<double> reach_m_, travel_m_;  // per vertex of all, from there
  std::vector<ContactPair> in_reach_, pairs_;
  std::vector<double> needed_m_;  // travel from which on each in reach counts
};

}  // namespace tacipc
