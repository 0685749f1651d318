// Largest fraction of a step that can be taken before anything touches or a tetrahedron inverts.
#pragma once

#include <limits>
#include <vector>

#include "stages/gel/press/contact/contact_search.h"

namespace tacipc {

/// Fraction of every gap that a step must leave.
struct GapRule {
  double slack = 0.1;  // fraction of the present gap beyond the floor
  /// Smallest gap, m, that may remain: at smaller gaps contact is so stiff that linear algebra loses its digits.
  double floor_m = 0;
  /// A wider gap counts as one of this width: nothing pushes there yet, so the pair may come as close as others.
  double near_m = std::numeric_limits<double>::infinity();
};

/// Largest t in (0, 1] up to which every pair at distance d keeps more than floor + slack (min(d, near) − floor) while
/// the vertices move from x to x + t p.
/// \throw SolverError if a pair is too close for any step
double contact_step_limit(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                          const GapRule& rule);

/// Pairs that allow less than all of p, in order.
std::vector<ContactPair> limiting_pairs(const std::vector<ContactPair>& pairs, const Positions& x, const Positions& p,
                                        const GapRule& rule);

/// A t in (0, 1] such that every tetrahedron keeps at least a tenth of its present volume on all of [0, t].
/// \throw SolverError if there is none above 1e-12
double inversion_step_limit(const Tetrahedra& tets, const Positions& x, const Positions& p);

/// Whether the Bernstein coefficients of the cubic c0 + c1 t + c2 t² + c3 t³ prove that it stays above `floor` on [0,
/// t]. The test is conservative: true is always right, false may be wrong.
bool cubic_stays_above(const double c[4], double t, double floor);

}  // namespace tacipc
