// Collision detection: contact pairs near a position or along a step, the smallest gap, and the largest fraction of a
// step that leaves enough of each gap.
#pragma once

#include <vector>

#include "stages/gel/press/contact/contact_search.h"
#include "stages/gel/press/solve/solver_model.h"
#include "stages/gel/press/solve/solver_times.h"
#include "stages/gel/press/solve/step_limit.h"

namespace tacipc {

/// Call start_step() before the first search of each time step: results then depend only on calls since.
class CollisionDetector {
 public:
  /// \param times sums over all steps, to which searches and limits are added
  CollisionDetector(const SolverModel& model, SolverTimes& times);

  /// Forgets earlier searches.
  /// \param held per object: whether it is held in this step
  /// \param world_from_gel rotations of several gels; empty: unchanged
  void start_step(std::vector<bool> held, const std::vector<Matrix3>& world_from_gel);

  /// Pairs within the largest d̂ at x, or a superset. The last result is cached: friction, forces and the gap of a
  /// solved step are computed at the same x.
  std::vector<ContactPair> pairs_at(const Positions& x);
  /// Pairs within the largest d̂ anywhere between x and x + p, or a superset.
  std::vector<ContactPair> pairs_along(const Positions& x, const Positions& p);

  /// Rule that keeps the fraction `slack` of each gap, but never less than a small fraction of d̂.
  GapRule gap_rule(double slack) const;
  /// Largest fraction of the step p from x, at most 1, that keeps the gap rule and leaves enough of every tetrahedron's
  /// volume.
  double step_limit(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p, double slack);
  /// Pairs that allow less than all of p.
  std::vector<ContactPair> limiting_pairs(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                                          double slack);

  /// Smallest gap between two bodies of which at least one can move by itself, capped at `none`. Gaps within a gel do
  /// not count.
  double smallest_gap(const Positions& x, double none);
  /// Smallest ratio of a gap to the d̂ of its two bodies, at most 1.
  double smallest_relative_gap(const Positions& x);

  ContactSearch& search() { return search_; }

 private:
  bool within_one_body(const ContactPair& pair) const;

  const SolverModel& model_;
  SolverTimes& times_;
  ContactSearch search_;
  struct {
    Positions x;
    std::vector<ContactPair> pairs;
  } last_search_;  // last result of pairs_at() in this time step
};

}  // namespace tacipc
