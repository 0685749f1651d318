#include "common/sample/rigid_way.h"

#include <Eigen/Geometry>
#include <cmath>

namespace tacipc {

Matrix3 RigidWay::turn() const {
  const double angle = turn_rad.norm();
  if (angle == 0.0) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, turn_rad / angle).toRotationMatrix();
}

Matrix4 moved(const Matrix4& pose, const RigidWay& by) {
  Matrix4 after = pose;
  after.topRightCorner<3, 1>() += by.shift_m;
  if (by.turn_rad != Vector3::Zero()) {
    const Matrix3 R = by.turn() * pose.topLeftCorner<3, 3>();
    after.topLeftCorner<3, 3>() = Eigen::Quaterniond(R).normalized().toRotationMatrix();
  }
  return after;
}

Matrix4 motion_of_world(const Matrix4& pose, const RigidWay& by) {
  const Vector3 at = pose.topRightCorner<3, 1>();
  Matrix4 motion = Matrix4::Identity();
  motion.topLeftCorner<3, 3>() = by.turn();
  motion.topRightCorner<3, 1>() = (Matrix3::Identity() - by.turn()) * at + by.shift_m;
  return motion;
}

Matrix4 pose_on_path(std::span<const Matrix4> path, double t) {
  const double nearest = std::round(t);
  // At whole numbers, return the pose of the path bit by bit.
  if (std::abs(t - nearest) < 1e-9) return path[static_cast<std::size_t>(nearest)];
  const auto before = static_cast<std::size_t>(t);
  const Matrix4 &a = path[before], &b = path[before + 1];
  const double part = t - static_cast<double>(before);
  const Eigen::Quaterniond from(Matrix3(a.topLeftCorner<3, 3>())), to(Matrix3(b.topLeftCorner<3, 3>()));
  Matrix4 pose = Matrix4::Identity();
  pose.topLeftCorner<3, 3>() = from.slerp(part, to).normalized().toRotationMatrix();
  pose.topRightCorner<3, 1>() = (1.0 - part) * a.topRightCorner<3, 1>() + part * b.topRightCorner<3, 1>();
  return pose;
}

}  // namespace tacipc
