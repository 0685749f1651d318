// Which part of a step may be taken before anything would touch or be inverted.
#pragma once

#include <limits>
#include <vector>

#include "stages/gel/press/contact/contact_search.h"

namespace tacipc {

/// The part of every gap that a step must leave.
struct GapRule {
  double slack = 0.1;  // part of the present gap beyond the floor
  double floor_m = 0;  // no gap falls to this: below it contact is so stiff that linear algebra loses its digits
  /// A gap wider than this counts as one of this: nothing pushes there yet, so the pair may come as near as others.
  double near_m = std::numeric_limits<double>::infinity();
};

/// Largest t in (0, 1] up to which every pair at distance d keeps more than floor + slack (min(d, near) − floor) while
/// the vertices move from x to x + t p. \throw SolverError if a pair is too near for any step.
double contact_step_limit(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                          const GapRule& rule);

/// The pairs that allow less than all of p, in order.
std::vector<ContactPair> limiting_pairs(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                                        const GapRule& rule);

/// A t in (0, 1] such that every tetrahedron keeps at least a tenth of its present volume on all of [0, t].
/// \throw SolverError if there is none above 1e-12.
double inversion_step_limit(const Tetrahedra& tets, const Positions& x, const Positions& p);

/// Whether the cubic c0 + c1 t + c2 t² + c3 t³ stays above `floor` on [0, t], by its Bernstein coefficients there: a
/// lower bound, so that the answer may be no for a cubic that does, but never yes for one that does not.
bool cubic_stays_above(const double c[4], double t, double floor);

}  // namespace tacipc
