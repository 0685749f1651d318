// Writes the surfaces of all bodies over time as NumPy arrays, for other simulators.
#pragma once

#include "common/stage/stage.h"
#include "stages/gel/export/open_press.h"

namespace tacipc {

/// Writes surfaces/<name>/{positions,velocities,triangles}.npy of each gel, object and soft body, in the world.
/// Velocities are the displacement since the previous frame over its duration; zero in frame 0.
void write_surface_arrays(Stage& stage, const OpenScene& scene);

}  // namespace tacipc
