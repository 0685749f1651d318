// Rigid displacements of a hand, a mount or a body with prescribed motion, over a time step or a phase.
#pragma once

#include <span>

#include "common/base/types.h"

namespace tacipc {

/// Largest rotation of a scene's body or a hand in one time step: a straight path cuts at most 0.5 % off.
inline constexpr double kLongestTurn_rad = 0.2;

/// A rigid displacement: shift in the world, and rotation about the moved frame's origin (a rotation vector, rad).
struct RigidWay {
  Vector3 shift_m = Vector3::Zero(), turn_rad = Vector3::Zero();

  RigidWay operator*(double part) const { return {part * shift_m, part * turn_rad}; }
  RigidWay operator-(const RigidWay& other) const { return {shift_m - other.shift_m, turn_rad - other.turn_rad}; }
  /// Returns the rotation matrix.
  Matrix3 turn() const;
};

/// Returns the pose after a displacement. Repeated calls keep the rotation orthogonal to rounding.
Matrix4 moved(const Matrix4& pose, const RigidWay& by);

/// Returns the rigid motion of the world that moves a frame from this pose by `by`.
Matrix4 motion_of_world(const Matrix4& pose, const RigidWay& by);

/// Smooth step: the fraction of a displacement completed after the fraction s of its time, 3s² − 2s³.
inline double smooth_part(double s) { return s * s * (3.0 - 2.0 * s); }

/// Interpolates a path at the time t, in units of poses: translation linear, rotation by slerp.
/// \pre 0 ≤ t ≤ path.size() − 1
Matrix4 pose_on_path(std::span<const Matrix4> path, double t);

}  // namespace tacipc
