// How a hand, a mount or a body that is told to goes, in a time step or a phase.
#pragma once

#include <span>

#include "common/base/types.h"

namespace tacipc {

/// Longest turn of a body of a scene, or of a hand, in one time step: a straight path cuts 0.5 % off at most.
inline constexpr double kLongestTurn_rad = 0.2;

/// A way in the world, and a turn about the moved frame's origin: a rotation vector, as long as the angle.
struct RigidWay {
  Vector3 shift_m = Vector3::Zero(), turn_rad = Vector3::Zero();

  RigidWay operator*(double part) const { return {part * shift_m, part * turn_rad}; }
  RigidWay operator-(const RigidWay& other) const { return {shift_m - other.shift_m, turn_rad - other.turn_rad}; }
  /// The rotation of the turn.
  Matrix3 turn() const;
};

/// A pose after that. Its rotation stays one to rounding, however often it is moved.
Matrix4 moved(const Matrix4& pose, const RigidWay& by);

/// The rigid motion of the world that takes a frame at this pose along.
Matrix4 motion_of_world(const Matrix4& pose, const RigidWay& by);

/// The part of a smooth way that is gone after the part s of its time: 3s² − 2s³.
inline double smooth_part(double s) { return s * s * (3.0 - 2.0 * s); }

/// Where a body on a path is at the time t, counted in poses: between two of them it goes straight and turns evenly.
/// \pre 0 ≤ t ≤ path.size() − 1
Matrix4 pose_on_path(std::span<const Matrix4> path, double t);

}  // namespace tacipc
