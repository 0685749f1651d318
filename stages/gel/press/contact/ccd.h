// Continuous collision detection along straight paths: how far a pair can go before it comes too close.
#pragma once

#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Time t in [0, 1] so that on all of [0, t] the distance of a pair (point x0 and triangle x1 x2 x3, or edges x0x1 and
/// x2x3) on the paths xᵢ + τ dᵢ stays above slack × initial distance, 0 ≤ slack < 1. 1 if the whole step is safe, 0 if
/// the start cannot be shown to be.
///
/// Every step forward is proven with a bound on all rounding errors (pair_motion.h), so the answer is never too large,
/// also for the rounded positions x + t d; it may be smaller than the largest possible. In the spirit of additive CCD
/// [Li2021], with separating planes and a volume test in place of the bound on the speed, so that sliding costs no
/// small steps.
double time_of_impact(ContactPair::Kind kind, const FourPoints& x, const FourPoints& displacement, double slack);

}  // namespace tacipc
