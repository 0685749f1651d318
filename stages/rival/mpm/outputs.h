// Writes the results of a run of material points.
#pragma once

#include <optional>

#include "common/stage/stage.h"
#include "stages/rival/mpm/half_speed.h"
#include "stages/rival/mpm/run_motion.h"

namespace tacipc {

/// Markers of every frame, #M × 3 each, m.
std::vector<Positions> markers_of_frames(const Sensor& sensor, const MpmScene& scene, const MpmRun& run);

/// Writes arrays, height maps and the summary of the record.
void write_outputs(Stage& stage, const Sensor& sensor, const MpmScene& scene, const MpmRun& run,
                   const std::vector<Positions>& markers, const std::optional<SpeedEffect>& effect);

}  // namespace tacipc
