// Every pair measured, in parallel.
#pragma once

#include <functional>
#include <vector>

#include "common/benchmark/metrics_rows.h"
#include "stages/study/metrics/image_pairs.h"

namespace tacipc {

/// The rows of all pairs in their order; pairs run in parallel. Where several fail, the first one's error is thrown.
std::vector<MetricsRow> measure_pairs(const std::vector<ImagePair>& pairs,
                                      const std::function<std::vector<MetricsRow>(const ImagePair&)>& measure);

}  // namespace tacipc
