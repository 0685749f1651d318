// Verdict on a frame: the limits that it must meet before it is saved.
#pragma once

#include <optional>

#include "common/base/error.h"
#include "common/sample/press_record.h"
#include "stages/gel/press/measure/balance.h"
#include "stages/gel/press/solve/step_report.h"

namespace tacipc {

/// Smallest load, N, by which a residual on a free body is divided.
inline constexpr double kSmallestBodyLoadN = 0.01;
/// Smallest force on a gel, N, that counts as contact.
inline constexpr double kTouches_n = 1e-6;

/// Limits that no configuration can change. The record repeats them.
inline constexpr PressLimits kVerdictLimits{.smallest_distance_m = 0.0,
                                            .intersections = 0,
                                            .gel_in_object = 0.5,  // winding numbers are 0 or 1, to rounding
                                            .inverted_tets = 0,
                                            .volume_ratio = 0.0,
                                            .balance_relative = 1e-3,
                                            .smallest_contact_n = kSmallestContactN,
                                            .pose_error_m = 1e-9,
                                            .body_strain = 1e-3,
                                            .body_balance_relative = 1e-3,
                                            .body_torque_relative = 1e-3,
                                            .body_torque_arm_m = kBodyTorqueArm_m,
                                            .smallest_body_load_n = kSmallestBodyLoadN};

/// Limits that follow from the configuration and the frame's contact force: the solver's tolerances.
struct SolverLimits {
  double velocity_residual_m_s = 0.0;
  double force_residual_n = 0.0;
  std::optional<double> friction_residual_n;  // absent if friction is lagged once per step, without a tolerance
};

/// Measured numbers of a frame.
struct FrameNumbers {
  std::optional<double> min_gap_m = {};  // absent: nothing is near
  int intersections = 0;
  int inverted_tets = 0;
  double gel_in_object = 0.0;  // winding number of the object's surface around the gel
  double min_volume_ratio = 0.0;
  double velocity_residual_m_s = 0.0;
  double force_residual_n = 0.0;
  double friction_residual_n = 0.0;
  double balance_n = 0.0;
  double balance_relative = 0.0;
  double pose_error_m = 0.0;
  double body_strain = 0.0;
  double body_balance_relative = 0.0;
  double body_torque_relative = 0.0;
};

/// Checks in this order: exact test, containment, inverted tetrahedra, smallest distance, volume ratio, velocity, force
/// and friction residual, balance, pose, strain and balances of force and torque of a free object. NaN fails every
/// check.
/// \throw VerdictError for the first failure
void judge_frame(int frame, const FrameNumbers& numbers, const SolverLimits& limits);

/// Throws if a press reached the gel's depth but touched nothing.
/// \param deepest_m lowest position of the object's lowest point, in S
/// \param front_low_m, front_high_m bounds of the undeformed front along x and y
[[noreturn]] void fail_untouched(int last_frame, const Vector3& deepest_m, const Eigen::Vector2d& front_low_m,
                                 const Eigen::Vector2d& front_high_m);

/// Largest allowed imbalance of a finger's drive after a time step, as a fraction of its force.
inline constexpr double kGripTolerance = 0.02;
/// Checks the drives of a grasp.
/// \param imbalance largest such fraction in the frame's time steps
/// \throw VerdictError if it exceeds kGripTolerance
void judge_grip(int frame, double imbalance);

}  // namespace tacipc
