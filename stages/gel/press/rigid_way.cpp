#include "stages/gel/press/rigid_way.h"

#include <Eigen/Geometry>

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

}  // namespace tacipc
