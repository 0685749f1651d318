// Writes all pages of a dataset, one after the other.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// Runs the stage if a plan is given: reads the samples of the dataset whose folder `plan/` contains --plan, finished
/// or not, and writes the pages. Samples are read a block at a time.
void report_dataset(Stage& stage);

}  // namespace tacipc
