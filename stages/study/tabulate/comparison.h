// Our images beside photographs and rivals: means, every image, and whether ours are ahead.
#pragma once

#include <string>
#include <vector>

#include "common/base/value.h"
#include "common/benchmark/benchmark_cases.h"
#include "stages/study/tabulate/method_scores.h"

namespace tacipc {

/// configs/studies/sim2real/comparison.yaml
struct ComparisonConfig {
  std::vector<MeasuredRow> rows;  // the first is the one judged, the second the one shown beside it

  static ComparisonConfig read(ConfigReader& in);
};

/// \throw DataError if the methods were not measured on the benchmark's images, and as read_methods
std::vector<MethodScores> read_comparison(const std::vector<NamedPath>& tables, const ComparisonConfig& config,
                                          const BenchmarkCases& cases);

struct Verdict {
  bool musts = false;  // of the first method, in the box
  bool ahead = false;  // on SSIM-S, MAE and PSNR in the box of every other method
};

/// The first method is the one judged.
Verdict judge(const std::vector<MethodScores>& methods, const BenchmarkCases& cases);

/// The page as Markdown: means of all methods, then every image.
std::string to_markdown(const std::vector<MethodScores>& methods, const BenchmarkCases& cases);
/// The verdict and the means of all methods, for the record.
Value::Map summary_of(const std::vector<MethodScores>& methods, const BenchmarkCases& cases);

}  // namespace tacipc
