// Sixteen particles of the gel, next to each other in memory.
#pragma once

#include "stages/rival/mpm/lanes.h"

namespace tacipc {

/// Units: lengths are in cells of the grid, times in steps, masses in masses of one gel particle. A particle's position
/// is its rest position plus its shift: a float resolves the small shift more finely than the position, so that a slow
/// step is not lost in rounding.
struct ParticlePack {
  Lanes rest[3];
  Lanes shift[3];
  Lanes velocity[3];
  Lanes affine[9];       // C, row-major: gradient of the velocity
  Lanes deformation[9];  // F, row-major
  IntLanes id;           // −1 for an empty lane: the last pack of a tile may be partly filled
};

/// Memory traffic of one particle in one step, bytes, without the grid. The scatter reads everything but the id. The
/// gather reads rest, shift and F, and writes all but rest and id; memory that is written without being read is first
/// fetched.
constexpr double kBytesPerParticleStep = 4.0 * ((3 + 3 + 3 + 9 + 9) + (3 + 3 + 9) + (3 + 3 + 9 + 9) + (3 + 9));

}  // namespace tacipc
