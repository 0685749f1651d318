// Numbers per frame as a table.
#pragma once

#include <string>

#include "stages/dataset/report/sample.h"

namespace tacipc {

/// A table to unfold, with a column for each number that a frame has. Of many frames some are left out, evenly; the
/// first, the last of each phase and the last stay. Empty if there are no frames.
std::string frames_table(const SampleReport& sample);

}  // namespace tacipc
