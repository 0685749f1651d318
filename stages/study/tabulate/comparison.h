// Compares TacIPC's images with photographs and with other simulators: means, every image, and the verdict.
#pragma once

#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/benchmark/benchmark_cases.h"
#include "stages/study/tabulate/method_scores.h"

namespace tacipc {

/// Content of configs/studies/sim2real/comparison.yaml.
struct ComparisonConfig {
  std::vector<MeasuredRow> rows;  // methods; the first is judged, the second is shown next to it

  static ComparisonConfig read(ConfigReader& in);
};

/// Reads the scores of all methods.
/// \throw DataError if the methods were not measured on the benchmark's images, and as read_methods
std::vector<MethodScores> read_comparison(const std::vector<NamedPath>& tables, const ComparisonConfig& config,
                                          const BenchmarkCases& cases);

/// Verdict on the first method.
struct Verdict {
  bool musts = false;  // the first method meets the required limits in the box
  bool ahead = false;  // the first method leads every other one on SSIM-S, MAE and PSNR in the box
};

/// Judges the first method.
Verdict judge(const std::vector<MethodScores>& methods, const BenchmarkCases& cases);

/// The page as Markdown: means of all methods, then every image.
std::string to_markdown(const std::vector<MethodScores>& methods, const BenchmarkCases& cases);
/// The verdict and the means of all methods, for the record.
Value::Map summary_of(const std::vector<MethodScores>& methods, const BenchmarkCases& cases);

}  // namespace tacipc
