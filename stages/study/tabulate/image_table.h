// The rows as text: Markdown for people, CSV for programs.
#pragma once

#include <string>
#include <vector>

#include "common/benchmark/image_speeds.h"
#include "stages/study/tabulate/method_scores.h"

namespace tacipc {

/// A table per region: a row per method, mean ± standard deviation, or geometric mean ×÷ factor; a line above the first
/// row of each group; printed means last, in the table of their region alone. `speeds`: of the rows' methods where they
/// were measured, a last column of the first table for each size of image. Then the caption, the findings and the
/// sheets. Characters that Markdown takes for a cell's end are escaped.
std::string to_markdown(const std::vector<MethodScores>& rows, const ImageTableConfig& config,
                        const std::vector<ImageSpeed>& speeds = {});

/// One line per number: `row,group,region,column,images,runs,mean,std,source`; std is over the runs if there are
/// several, else over the images. Measured numbers are in the shortest form that reads back to the same bits and have
/// no source; printed ones have no number of images or runs and no deviation.
std::string to_csv(const std::vector<MethodScores>& rows, const ImageTableConfig& config);

}  // namespace tacipc
