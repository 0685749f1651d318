// Motion of a sample: the request as text, and the frames of each phase.
#pragma once

#include <string>
#include <vector>

#include "common/stage/record.h"

namespace tacipc {

/// Frames of one phase of the motion.
struct PhaseReport {
  std::string name;
  int first = 0;
  int last = 0;
};

/// Text such as "press 0.5 mm, shear 1 mm towards 90°" for the `motion` of a sample, one map or a list of them; for a
/// dataset's motion "press 0.3 to 0.7 mm". Empty without a motion.
std::string motion_text(const Record& sample);

/// Depth of the first press that has one, in mm.
std::optional<double> asked_depth_mm(const Record& sample);

/// Phases as runs of equal names, also split between phases of `sample` if their steps are given. Empty if a frame has
/// no name.
std::vector<PhaseReport> phases_of(const std::vector<std::string>& frame_names, const Record& sample);

/// Frames worth showing, ascending: the last of each phase of motion and the last of all. If there are too many,
/// `max_count` evenly spread ones, including the last.
/// \pre frames ≥ 1, max_count ≥ 1
std::vector<int> chosen_frames(const std::vector<PhaseReport>& phases, int frames, int max_count);

}  // namespace tacipc
