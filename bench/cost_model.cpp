#include "bench/cost_model.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tacipc_bench_texts.h"

namespace tacipc::bench {
namespace {

constexpr int kSweeps = 50;

/// ln c_press, ln c_motion, a, b and ln of the averaged element's factor.
using Parameters = Eigen::Vector<double, 5>;

/// Logarithm of the predicted time, and its derivatives.
double log_cost(const Run& run, const Parameters& at, Parameters& slope) {
  double sum = 0.0;
  slope.setZero();
  const double v = std::log(run.gel_vertices / 1000.0);
  for (const Frame& frame : run.frames) {
    const double t = std::log1p(frame.contacts / 100.0);
    const double cost = std::exp((frame.press ? at[0] : at[1]) + at[2] * v + at[3] * t);
    sum += cost;
    slope += cost * Parameters{frame.press ? 1.0 : 0.0, frame.press ? 0.0 : 1.0, v, t, 0.0};
  }
  slope /= sum;
  const double averaged = run.name.route == "averaged" ? 1.0 : 0.0;
  slope[4] = averaged;
  return std::log(sum) + averaged * at[4];
}

}  // namespace

double CostModel::predict(const Run& run) const {
  Parameters ignored;
  const Parameters at{std::log(press_s), std::log(motion_s), vertices_exponent, contacts_exponent,
                      std::log(averaged_factor)};
  return std::exp(log_cost(run, at, ignored));
}

CostModel fit_cost_model(const std::vector<Run>& runs) {
  Parameters at{std::log(0.05), std::log(0.05), 1.2, 0.5, 0.0};
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    Eigen::Matrix<double, 5, 5> normal = 1e-9 * Eigen::Matrix<double, 5, 5>::Identity();
    Parameters rhs = Parameters::Zero();
    for (const Run& run : runs) {
      Parameters slope;
      const double miss = std::log(run.processor_s) - log_cost(run, at, slope);
      normal += slope * slope.transpose();
      rhs += miss * slope;
    }
    at += normal.ldlt().solve(rhs);
  }
  CostModel model{.press_s = std::exp(at[0]),
                  .motion_s = std::exp(at[1]),
                  .averaged_factor = std::exp(at[4]),
                  .vertices_exponent = at[2],
                  .contacts_exponent = at[3],
                  .runs = static_cast<int>(runs.size())};
  for (const Run& run : runs) {
    const double ratio = run.processor_s / model.predict(run);
    model.largest_ratio = std::max({model.largest_ratio, ratio, 1.0 / ratio});
  }
  return model;
}

std::string to_yaml_text(const CostModel& m) {
  return fmt::format(kCostModel, m.runs, m.largest_ratio, m.press_s, m.motion_s, m.vertices_exponent,
                     m.contacts_exponent, m.averaged_factor);
}

}  // namespace tacipc::bench
