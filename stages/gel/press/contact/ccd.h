// Continuous collision detection along straight paths: largest step before a pair comes too close.
#pragma once

#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Time t in [0, 1] up to which a pair on the paths xᵢ + τ dᵢ stays farther apart than slack × its initial distance, 0
/// ≤ slack < 1. The pair is point x0 and triangle x1 x2 x3, or edges x0x1 and x2x3. Returns 1 if the whole step is
/// safe, 0 if the start cannot be proven to be.
///
/// Every advance is proven with a bound on all rounding errors (pair_motion.h), so the result is never too large, also
/// for the rounded positions x + t d; it may be smaller than the largest possible. The method resembles additive CCD
/// [Li2021], with separating planes and a volume test instead of the bound on the speed, so that sliding needs no small
/// steps.
double time_of_impact(ContactPair::Kind kind, const FourPoints& x, const FourPoints& displacement, double slack);

}  // namespace tacipc
