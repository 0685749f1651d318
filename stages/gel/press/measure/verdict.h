// The judgement of one frame: what must hold before it may be saved.
#pragma once

#include <optional>

#include "common/base/error.h"

namespace tacipc {

/// The limits that no configuration can move, as the record repeats them; docs/verdict.md says what each is for.
struct VerdictLimits {
  double smallest_distance_m = 0.0;  // between gel and object, must be exceeded
  int intersections = 0;             // pairs of triangles that share a point, decided exactly
  double gel_in_object = 0.5;        // how many times the object's surface winds around the gel: 0 or 1, to rounding
  int inverted_tets = 0;             // tetrahedra whose exact volume is not positive
  double volume_ratio = 0.0;         // smallest deformed over undeformed volume, must be exceeded
  double balance_relative = 1e-3;    // of the contact force, which counts as at least kSmallestContactN
  double pose_error_m = 1e-9;        // of the object's vertices from where the motion prescribes them
  // Of an object that moves freely: max |AᵀA − I|, and what is missing to the balance of its momentum, as part of its
  // weight or load, whichever is larger, at least of kSmallestBodyLoadN.
  double body_strain = 1e-3;
  double body_balance_relative = 1e-3;
};
inline constexpr VerdictLimits kVerdictLimits;
inline constexpr double kSmallestBodyLoadN = 0.01;

/// The limits that follow from the configuration and the frame's contact force: what the solver promised to reach.
struct SolverLimits {
  double velocity_residual_m_s = 0.0;
  double force_residual_n = 0.0;
  std::optional<double> friction_residual_n;  // absent where friction is lagged once, without a promise
};

/// What was measured of a frame.
struct FrameNumbers {
  double min_gap_m = 0.0;
  int intersections = 0;
  int inverted_tets = 0;
  double gel_in_object = 0.0;  // how many times the object's surface winds around the gel
  double min_volume_ratio = 0.0;
  double velocity_residual_m_s = 0.0;
  double force_residual_n = 0.0;
  double friction_residual_n = 0.0;
  double balance_n = 0.0;
  double balance_relative = 0.0;
  double pose_error_m = 0.0;
  double body_strain = 0.0;
  double body_balance_relative = 0.0;
};

/// Checks in this order: exact test, containment, inverted tetrahedra, smallest distance, volume ratio, velocity, force
/// and friction residual, balance, pose, strain and balance of a free object. A number that is not a number misses its
/// limit. \throw VerdictError for the first miss.
void judge_frame(int frame, const FrameNumbers& numbers, const SolverLimits& limits);

}  // namespace tacipc
