// Tables and a plot over the presses of the benchmark.
#pragma once

#include <string>
#include <vector>

#include "bench/cost_model.h"

namespace tacipc::bench {

/// The page docs/performance.md: the routes beside each other, where the time goes, threads and processes, the cost
/// model. `processor`: what it was measured on.
std::string bench_page(const std::vector<Run>& runs, const CostModel& model, const std::string& processor);

/// Processor seconds of presses over vertices, a curve for each object and route.
std::string bench_svg(const std::vector<Run>& runs);

}  // namespace tacipc::bench
