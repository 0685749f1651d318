#include "stages/gel/press/world/frame.h"

#include <fmt/core.h>

#include <algorithm>

namespace tacipc {

std::string gap_text(const std::optional<double>& gap_m) {
  return gap_m ? fmt::format("{:.3g} um", 1e6 * *gap_m) : "-";
}

FrameNumbers numbers_of(const Frame& frame) {
  return {
      .min_gap_m = frame.min_gap_m,
      .intersections = frame.intersections,
      .inverted_tets = frame.inverted_tets,
      .gel_in_object = frame.gel_in_object,
      .min_volume_ratio = frame.min_volume_ratio,
      .velocity_residual_m_s = frame.solver.velocity_residual_m_s,
      .force_residual_n = frame.solver.force_residual_n,
      .friction_residual_n = frame.solver.friction_residual_n,
      .balance_n = frame.balance.force_n,
      .balance_relative = frame.balance.relative,
      .pose_error_m = frame.pose_error_m,
      .body_strain = frame.body_strain,
      .body_balance_relative = frame.solver.body_residual_n / std::max(frame.solver.body_load_n, kSmallestBodyLoadN),
      .body_torque_relative =
          frame.solver.body_residual_n_m / (kBodyTorqueArm_m * std::max(frame.solver.body_load_n, kSmallestBodyLoadN))};
}

SolverLimits limits_of(const PressConfig& config, const NewtonSettings& newton, double contact_force_n) {
  SolverLimits limits{.velocity_residual_m_s = newton.velocity_tolerance_m_s,
                      .force_residual_n = newton.force_limit_n(contact_force_n),
                      .friction_residual_n = {}};
  if (config.friction && config.friction->iterated)
    limits.friction_residual_n =
        std::max(newton.force_tolerance_n, config.friction->relative_lag_tolerance * contact_force_n);
  return limits;
}

}  // namespace tacipc
