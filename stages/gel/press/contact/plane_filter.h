// A quick proof that a moving pair stays apart, for eight pairs at a time.
#pragma once

#include "common/base/simd.h"
#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Of eight pairs of one kind those (their bits) that a fixed plane shows to stay farther apart than `slack` times
/// their distance, or times `near_m` if that is less, + (1 − slack) `floor_m`, all along the path from x to x + until ×
/// p; most do. `x` and `p` are #V × 3.
/// Rounding is allowed for: pairs reported do stay apart, also on the paths of doubles.
unsigned stay_apart(const double* x, const double* p, double until, const ContactPair* const* pairs,
                    ContactPair::Kind kind, double slack, const Pack& floor_m, const Pack& near_m);

}  // namespace tacipc
