// Which of eight pairs cannot come near each other on their way, by a glance.
#pragma once

#include "common/simd.h"
#include "stages/press/contact/contact_pair.h"

namespace tacipc {

/// Of eight pairs of one kind those (their bits) that a fixed plane shows to stay farther apart than `slack` times
/// their distance + (1 − slack) `floor_m`, all the way from x to x + until × p; most do. `x` and `p` are #V × 3.
/// Rounding is allowed for: what is said to stay apart does, also on the paths of doubles.
unsigned apart_all_the_way(const double* x, const double* p, double until, const ContactPair* const* pairs,
                           ContactPair::Kind kind, double slack, const Pack& floor_m);

}  // namespace tacipc
