// Every pair measured, in parallel.
#pragma once

#include <vector>

#include "common/base/each_in_threads.h"
#include "common/benchmark/metrics_rows.h"
#include "stages/study/metrics/image_pairs.h"

namespace tacipc {

/// The rows of all pairs in their order; pairs run in parallel. Where several fail, the first one's error is thrown.
template <typename Measure>
std::vector<MetricsRow> measure_pairs(const std::vector<ImagePair>& pairs, const Measure& measure) {
  std::vector<std::vector<MetricsRow>> of_pair(pairs.size());
  each_in_threads(pairs.size(), [&](std::size_t i) { of_pair[i] = measure(pairs[i]); });
  std::vector<MetricsRow> rows;
  for (const auto& some : of_pair) rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

}  // namespace tacipc
