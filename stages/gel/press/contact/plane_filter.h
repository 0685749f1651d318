// Quick certificate that moving pairs stay apart, for eight pairs at a time.
#pragma once

#include "common/base/simd.h"
#include "stages/gel/press/contact/contact_pair.h"

namespace tacipc {

/// Bits of those among eight pairs of one kind that a fixed plane proves to stay apart along the path from x to x +
/// until × p. The required distance is slack × min(distance, `near_m`) + (1 − slack) `floor_m`; most pairs keep it. `x`
/// and `p` are #V × 3. Rounding is included: pairs reported also stay apart on the paths rounded to doubles.
unsigned stay_apart(const double* x, const double* p, double until, const ContactPair* const* pairs,
                    ContactPair::Kind kind, double slack, const Pack& floor_m, const Pack& near_m);

}  // namespace tacipc
