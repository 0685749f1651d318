// All pages of a dataset, written one after the other.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// The stage's work where a plan is given: reads the samples of the dataset that --plan lies in (its folder `plan/`),
/// however far they are, and writes the pages. Samples are read a block at a time.
void report_dataset(Stage& stage);

}  // namespace tacipc
