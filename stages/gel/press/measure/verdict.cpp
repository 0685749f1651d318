#include "stages/gel/press/measure/verdict.h"

#include <cmath>

namespace tacipc {

void judge_frame(int frame, const FrameNumbers& numbers, const SolverLimits& limits) {
  const auto miss = [frame](const char* check, double value, double limit, const std::string& reason) {
    throw VerdictError({.frame = frame, .check = check, .value = value, .limit = limit},
                       fmt::format("frame {}: {}", frame, reason));
  };
  // Each condition states what is required, so that NaN never passes.
  const auto exceeds = [&](const char* check, const char* what, double value, double limit, const char* unit) {
    if (!(value > limit))
      miss(check, value, limit, fmt::format("{} {:.3g}{} does not exceed {:g}", what, value, unit, limit));
  };
  const auto within = [&](const char* check, const char* what, double value, double limit, const char* unit) {
    if (!(value <= limit))
      miss(check, value, limit, fmt::format("{} {:.3g}{} exceeds {:.3g}{}", what, value, unit, limit, unit));
  };

  if (numbers.intersections > kVerdictLimits.intersections) {
    miss("intersections", numbers.intersections, kVerdictLimits.intersections,
         fmt::format("{} pairs of triangles intersect", numbers.intersections));
  }
  if (!(std::abs(numbers.gel_in_object) < kVerdictLimits.gel_in_object)) {
    miss("containment", numbers.gel_in_object, kVerdictLimits.gel_in_object,
         fmt::format("the gel is inside the object (its surface winds {:.2g} times around it)", numbers.gel_in_object));
  }
  if (numbers.inverted_tets > kVerdictLimits.inverted_tets) {
    miss("inverted_tets", numbers.inverted_tets, kVerdictLimits.inverted_tets,
         fmt::format("{} tetrahedra are inverted", numbers.inverted_tets));
  }
  if (numbers.min_gap_m)
    exceeds("smallest_distance", "smallest distance", *numbers.min_gap_m, kVerdictLimits.smallest_distance_m, " m");
  exceeds("volume_ratio", "smallest volume ratio", numbers.min_volume_ratio, kVerdictLimits.volume_ratio, "");
  within("velocity_residual", "velocity residual", numbers.velocity_residual_m_s, limits.velocity_residual_m_s, " m/s");
  within("force_residual", "force residual", numbers.force_residual_n, limits.force_residual_n, " N");
  if (limits.friction_residual_n)
    within("friction_residual", "friction residual", numbers.friction_residual_n, *limits.friction_residual_n, " N");
  if (!(numbers.balance_relative <= kVerdictLimits.balance_relative)) {
    miss("balance", numbers.balance_relative, kVerdictLimits.balance_relative,
         fmt::format("forces do not balance: residual {:.3g} N, {:.3g} of the contact force (limit {:g})",
                     numbers.balance_n, numbers.balance_relative, kVerdictLimits.balance_relative));
  }
  within("pose_error", "pose error", numbers.pose_error_m, kVerdictLimits.pose_error_m, " m");
  within("body_strain", "strain of the free object", numbers.body_strain, kVerdictLimits.body_strain, "");
  within("body_balance", "part of the free object's load that is not balanced,", numbers.body_balance_relative,
         kVerdictLimits.body_balance_relative, "");
  within("body_torque", "torque on the free object that is not balanced, as a fraction of its load on 10 mm,",
         numbers.body_torque_relative, kVerdictLimits.body_torque_relative, "");
}

void fail_untouched(int last_frame, const Vector3& deepest_m, const Eigen::Vector2d& front_low_m,
                    const Eigen::Vector2d& front_high_m) {
  throw VerdictError(
      {.frame = last_frame, .check = "contact", .value = 0.0, .limit = 0.0},
      fmt::format(
          "frame {}: nothing has touched the gel: the object's lowest point went {:.3g} mm below the undeformed "
          "front at x {:.3g} mm, y {:.3g} mm, but the front reaches from {:.3g} to {:.3g} mm and from {:.3g} to "
          "{:.3g} mm. Place it with placement.center_mm, or say placement.may_miss: true",
          last_frame, -1e3 * deepest_m.z(), 1e3 * deepest_m.x(), 1e3 * deepest_m.y(), 1e3 * front_low_m.x(),
          1e3 * front_high_m.x(), 1e3 * front_low_m.y(), 1e3 * front_high_m.y()));
}

void judge_grip(int frame, double imbalance) {
  if (imbalance <= kGripTolerance) return;
  throw VerdictError({.frame = frame, .check = "grip_balance", .value = imbalance, .limit = kGripTolerance},
                     fmt::format("frame {}: {:.3g} of the force is missing to the balance of a finger's drive (limit "
                                 "{:g}): give the phase more substeps, or the drive damping",
                                 frame, imbalance, kGripTolerance));
}

}  // namespace tacipc
