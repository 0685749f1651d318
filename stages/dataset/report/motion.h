// The motion of a sample: what was asked for in words, and which frames belong to which phase.
#pragma once

#include <string>
#include <vector>

#include "common/stage/record.h"

namespace tacipc {

/// Frames that belong together: one phase of the motion.
struct PhaseReport {
  std::string name;
  int first = 0;
  int last = 0;
};

/// "press 0.5 mm, shear 1 mm towards 90°": the `motion` of a sample, one map or a list of them; of a dataset's motion
/// "press 0.3 to 0.7 mm". Empty if there is none.
std::string motion_text(const Record& sample);

/// Depth of the first press that names one, in mm.
std::optional<double> asked_depth_mm(const Record& sample);

/// Runs of equal names, cut also where one phase of `sample` ends and the next begins, if its steps tell. Nothing where
/// a frame has no name.
std::vector<PhaseReport> phases_of(const std::vector<std::string>& frame_names, const Record& sample);

/// The frames worth a look, ascending: the last of each phase of motion and the last of all; of many, `max_count`
/// evenly chosen ones with the last among them. \pre frames ≥ 1, max_count ≥ 1
std::vector<int> chosen_frames(const std::vector<PhaseReport>& phases, int frames, int max_count);

}  // namespace tacipc
