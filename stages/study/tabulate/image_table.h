// Writes the rows as Markdown for people and as CSV for programs.
#pragma once

#include <string>
#include <vector>

#include "common/benchmark/image_speeds.h"
#include "stages/study/tabulate/method_scores.h"

namespace tacipc {

/// Markdown with a table per region and a row per method: mean ± standard deviation, or geometric mean ×÷ factor. A
/// line precedes the first row of each group; printed means come last, only in the table of their region. Then follow
/// the caption, the findings and the sheets. Characters that would end a Markdown cell are escaped.
/// \param speeds measured speeds of the rows' methods: a last column of the first table for each image size
std::string to_markdown(const std::vector<MethodScores>& rows, const ImageTableConfig& config,
                        const std::vector<ImageSpeed>& speeds = {});

/// CSV with one line per number: `row,group,region,column,images,runs,mean,std,source`. std is over the runs if there
/// are several, otherwise over the images. Measured numbers have the shortest form that reads back to the same bits,
/// and no source; printed ones have no number of images or runs and no deviation.
std::string to_csv(const std::vector<MethodScores>& rows, const ImageTableConfig& config);

}  // namespace tacipc
