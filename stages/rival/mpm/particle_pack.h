// Sixteen particles of the gel, side by side in memory.
#pragma once

#include "stages/rival/mpm/lanes.h"

namespace tacipc {

/// Lengths are in cells of the grid, times in steps, masses in masses of one gel particle. A particle is where it was
/// at rest plus its shift: a float holds the small shift more finely than the place, so that a slow step is not lost in
/// rounding.
struct ParticlePack {
  Lanes rest[3];
  Lanes shift[3];
  Lanes velocity[3];
  Lanes affine[9];       // C, row-major: the velocity's gradient
  Lanes deformation[9];  // F, row-major
  IntLanes id;           // −1 where there is none: the last pack of a tile need not be full
};

/// Bytes of memory traffic of one particle in one step, without the grid: the scatter reads everything but the id, the
/// gather reads rest, shift and F and writes all but rest and id; what is written unread is first fetched.
constexpr double kBytesPerParticleStep = 4.0 * ((3 + 3 + 3 + 9 + 9) + (3 + 3 + 9) + (3 + 3 + 9 + 9) + (3 + 9));

}  // namespace tacipc
