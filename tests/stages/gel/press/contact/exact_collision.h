// Truth for queries: does a pair on straight paths ever touch, decided in integers.
#pragma once

#include "stages/gel/press/contact/pair_motion.h"

namespace tacipc {

enum class Collision { free, hit, undecided };

/// On the paths x + t d, 0 ≤ t ≤ until, without any rounding. Undecided are pairs that touch at a boundary or stay in
/// one plane, where bisection of the time never ends. Works from the coplanarity cubic and the position of the meeting
/// point in triangle or edges, and so shares neither arithmetic nor idea with separating planes.
Collision exact_collision(ContactPair::Kind kind, const FourPoints& x, const FourPoints& displacement,
                          double until = 1);

}  // namespace tacipc
