// What happened over the frames of a sample, as drawings and as a table.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/report/sample.h"

namespace tacipc {

/// Press force over depth: one mark per frame, joined by a line; axes in mm and N with ticks. \pre at least one frame,
/// each with a depth
std::string press_curve_svg(const std::vector<FrameReport>& frames);

/// The drawings over frames that there are numbers for, each a figure of HTML with its caption: forces, contact area
/// and pressure, tangential over press force (with friction), force balance.
std::string frame_curves(const SampleReport& sample);

/// A table to unfold, with a column for each number that a frame has. Of many frames some are left out, evenly; the
/// first, the last of each phase and the last stay. Empty if there are no frames.
std::string frames_table(const SampleReport& sample);

}  // namespace tacipc
