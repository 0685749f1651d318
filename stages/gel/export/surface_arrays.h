// The surfaces of all bodies over time as NumPy arrays, for other simulators.
#pragma once

#include "common/stage/stage.h"
#include "stages/gel/export/open_press.h"

namespace tacipc {

/// surfaces/<name>/{positions,velocities,triangles}.npy of each gel, object and soft body, in the world: velocities are
/// the way since the frame before over its time; zero in frame 0.
void write_surface_arrays(Stage& stage, const OpenScene& scene);

}  // namespace tacipc
