// What a press will cost, from what presses have cost.
#pragma once

#include <string>
#include <vector>

#include "bench/bench_run.h"

namespace tacipc::bench {

/// Processor seconds of a run = Σ over its frames of c · (vertices / 1000)^a · (1 + touching / 100)^b, c for frames of
/// a press and of motions after it apart; with linear tetrahedra, and so many times that with averaged volumes (runs of
/// the route `averaged`).
struct CostModel {
  double press_s = 0.0, motion_s = 0.0;  // c
  double averaged_factor = 1.0;
  double vertices_exponent = 0.0, contacts_exponent = 0.0;
  double largest_ratio = 1.0;  // of a run's time over the model's, or the reverse
  int runs = 0;

  double predict(const Run& run) const;
};

/// Least squares of the logarithms over all runs, by Gauss–Newton. \pre at least five runs, of both kinds and with both
/// elements (the factor stays 1 without)
CostModel fit_cost_model(const std::vector<Run>& runs);

/// As YAML, with units and where it comes from.
std::string to_yaml_text(const CostModel& model);

}  // namespace tacipc::bench
