#include "stages/study/metrics/measure_pairs.h"

#include "common/base/each_in_threads.h"

namespace tacipc {

std::vector<MetricsRow> measure_pairs(const std::vector<ImagePair>& pairs,
                                      const std::function<std::vector<MetricsRow>(const ImagePair&)>& measure) {
  std::vector<std::vector<MetricsRow>> of_pair(pairs.size());
  each_in_threads(pairs.size(), [&](std::size_t i) { of_pair[i] = measure(pairs[i]); });
  std::vector<MetricsRow> rows;
  for (const auto& some : of_pair) rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

}  // namespace tacipc
