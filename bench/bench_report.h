// Tables and a plot over the presses of the benchmark.
#pragma once

#include <string>
#include <vector>

#include "bench/cost_model.h"

namespace tacipc::bench {

/// Markdown: the routes beside each other, where the time goes, threads and processes.
std::string bench_tables(const std::vector<Run>& runs, const CostModel& model);

/// Processor seconds over vertices, a curve for each object, motion and route.
std::string bench_svg(const std::vector<Run>& runs);

}  // namespace tacipc::bench
