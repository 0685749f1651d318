// Scores of several methods on the same photographs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/benchmark_cases.h"

namespace tacipc {

/// One region (box or full) of one image.
struct Score {
  double ssim_s = 0.0;
  double ssim_w = 0.0;
  double mae = 0.0;
  double psnr_db = 0.0;
};

struct MethodScores {
  std::string name;
  std::vector<Score> box;  // in the order of the benchmark's images
  std::vector<Score> full;
};

/// Reads samples.csv of the metrics stage. \throw DataError if a column, an image or a region is missing
MethodScores read_scores(const std::filesystem::path& samples, const std::string& name, const BenchmarkCases& cases);

Score mean_of(const std::vector<Score>& scores);

struct Verdict {
  bool musts = false;  // of the first method, in the box
  bool ahead = false;  // on SSIM-S, MAE and PSNR in the box of every other method
};

/// The first method is the one judged.
Verdict judge(const std::vector<MethodScores>& methods, const BenchmarkCases& cases);

/// The page as Markdown: means of all methods, then every image.
std::string to_markdown(const std::vector<MethodScores>& methods, const BenchmarkCases& cases);

}  // namespace tacipc
