// Predicts the cost of a press from measured presses.
#pragma once

#include <string>
#include <vector>

#include "bench/bench_run.h"

namespace tacipc::bench {

/// Processor seconds of a run: Σ over its frames of c · (vertices / 1000)^a · (1 + touching / 100)^b. The factor c
/// differs between frames of a press and of motions after it. It holds for linear tetrahedra; runs with averaged
/// volumes (route `averaged`) cost `averaged_factor` times as much.
struct CostModel {
  double press_s = 0.0, motion_s = 0.0;  // factor c, s
  double averaged_factor = 1.0;
  double vertices_exponent = 0.0, contacts_exponent = 0.0;
  double largest_ratio = 1.0;  // largest ratio between a run's time and the prediction, or its inverse
  int runs = 0;

  double predict(const Run& run) const;
};

/// Least squares of the logarithms over all runs, by Gauss–Newton. Without runs of both elements `averaged_factor`
/// stays 1.
/// \pre at least five runs, with frames of both kinds
CostModel fit_cost_model(const std::vector<Run>& runs);

/// YAML with units and the source of the numbers.
std::string to_yaml_text(const CostModel& model);

}  // namespace tacipc::bench
