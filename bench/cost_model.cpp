#include "bench/cost_model.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace tacipc::bench {
namespace {

constexpr int kSweeps = 50;

/// ln of the predicted time and its derivatives by (ln c_press, ln c_motion, a, b).
double log_cost(const Run& run, const Eigen::Vector4d& at, Eigen::Vector4d& slope) {
  double sum = 0.0;
  slope.setZero();
  const double v = std::log(run.gel_vertices / 1000.0);
  for (const Frame& frame : run.frames) {
    const double t = std::log1p(frame.contacts / 100.0);
    const double cost = std::exp((frame.press ? at[0] : at[1]) + at[2] * v + at[3] * t);
    sum += cost;
    slope += cost * Eigen::Vector4d(frame.press ? 1.0 : 0.0, frame.press ? 0.0 : 1.0, v, t);
  }
  slope /= sum;
  return std::log(sum);
}

}  // namespace

double CostModel::predict(const Run& run) const {
  Eigen::Vector4d ignored;
  return std::exp(
      log_cost(run, {std::log(press_s), std::log(motion_s), vertices_exponent, contacts_exponent}, ignored));
}

CostModel fit_cost_model(const std::vector<Run>& runs) {
  Eigen::Vector4d at(std::log(0.05), std::log(0.05), 1.2, 0.5);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    Eigen::Matrix4d normal = 1e-9 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d rhs = Eigen::Vector4d::Zero();
    for (const Run& run : runs) {
      Eigen::Vector4d slope;
      const double miss = std::log(run.processor_s) - log_cost(run, at, slope);
      normal += slope * slope.transpose();
      rhs += miss * slope;
    }
    at += normal.ldlt().solve(rhs);
  }
  CostModel model{.press_s = std::exp(at[0]),
                  .motion_s = std::exp(at[1]),
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
  return fmt::format(
      "# What a press costs on one core, fitted to {} presses by make -f Makefile.data bench-press:\n"
      "# seconds of a frame = c (gel vertices / 1000)^vertices_exponent (1 + touching front vertices / "
      "100)^contacts_exponent,\n"
      "# c for frames of a press and of motions after it. No press it was fitted to is off by more than a factor of "
      "{:.2f}.\n"
      "press_frame_s: {:.4g}\n"
      "motion_frame_s: {:.4g}\n"
      "vertices_exponent: {:.3f}\n"
      "contacts_exponent: {:.3f}\n",
      m.runs, m.largest_ratio, m.press_s, m.motion_s, m.vertices_exponent, m.contacts_exponent);
}

}  // namespace tacipc::bench
