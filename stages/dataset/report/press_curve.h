// Shows the frames of a sample as drawings and as a table.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/report/sample.h"

namespace tacipc {

/// Press force over depth: one mark per frame, joined by a line; axes in mm and N with ticks.
/// \pre at least one frame, each with a depth
std::string press_curve_svg(const std::vector<FrameReport>& frames);

/// Drawings over frames for which there are numbers, each a figure of HTML with its caption: forces, contact area and
/// pressure, tangential over press force (with friction), force balance.
std::string frame_curves(const SampleReport& sample);

/// Folded table with a column for each number of a frame. If there are many frames, some are left out evenly, but not
/// the first, the last of each phase, and the last. Empty without frames.
std::string frames_table(const SampleReport& sample);

}  // namespace tacipc
