// Inputs of the stages of a marker benchmark, from its one file.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/benchmark/marker_benchmark.h"

namespace tacipc {

/// Name and content of each file: cases.mk (variables for Make), motion_<µm>.yaml per depth, and for the base and each
/// variant that is simulated <name>/{indenter.yaml, friction.yaml}, the latter to follow the press configuration, which
/// has no section friction. Make puts thickness into a copy of the sensor. `folder` is that of the benchmark's file:
/// paths in it are relative to there.
std::vector<std::pair<std::string, std::string>> marker_files(const MarkerBenchmark& benchmark,
                                                              const std::string& folder);

}  // namespace tacipc
