// Inputs of the stages of a photograph benchmark, from its one file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/benchmark/benchmark_cases.h"

namespace tacipc {

/// Name and content of each file: cases.mk (variables for Make), ball/ and <object>/ {indenter.yaml, motion.yaml,
/// shade.yaml}, metrics.yaml; with circles labels.txt and background.yaml, and no press but that of ball/. `folder` is
/// that of the benchmark's file: paths in it are relative to there.
std::vector<std::pair<std::string, std::string>> case_files(const BenchmarkCases& cases, const std::string& folder);

}  // namespace tacipc
