// Decides pairs that pass each other closer than double precision can resolve: the proofs of pair_motion.h with 113
// bits.
#pragma once

#include "stages/gel/press/contact/ccd.h"
#include "stages/gel/press/contact/pair_motion.h"

namespace tacipc {

/// True only if the pair provably stays apart while its vertices go straight from x_start to x_end. Sees gaps down to
/// about 1e-30 of the size of the pair; slow (up to milliseconds), and about exact paths, not about
/// positions rounded in between.
bool provably_apart(ContactPair::Kind kind, const FourPoints& x_start, const FourPoints& x_end,
                    double known_apart_until = 0);

/// False only if the pair provably stays apart on the whole straight path from x_start to x_end, however near it
/// passes: a pair that time of impact 1 without slack cannot clear within double rounding is tried again with 113 bits.
bool may_collide(ContactPair::Kind kind, const FourPoints& x_start, const FourPoints& x_end);

}  // namespace tacipc
