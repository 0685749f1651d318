#include "common/sample/placement.h"

#include <Eigen/Geometry>
#include <numbers>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Returns the rotation of a named face towards −z, by whole quarter turns so that its entries are exact.
Matrix3 face_down(const std::string& face) {
  Matrix3 rotation;
  if (face == "-z") {
    rotation = Matrix3::Identity();
  } else if (face == "+z") {
    rotation << 1, 0, 0, 0, -1, 0, 0, 0, -1;  // 180° about x
  } else if (face == "+x") {
    rotation << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // 90° about y
  } else if (face == "-x") {
    rotation << 0, 0, -1, 0, 1, 0, 1, 0, 0;  // −90° about y
  } else if (face == "+y") {
    rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // −90° about x
  } else if (face == "-y") {
    rotation << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // 90° about x
  } else {
    throw UsageError("'" + face + "' is not a face (+x, -x, +y, -y, +z, -z)");
  }
  return rotation;
}

}  // namespace

const std::vector<std::string>& face_names() {
  static const std::vector<std::string> names{"+x", "-x", "+y", "-y", "+z", "-z"};
  return names;
}

std::string opposite_face(const std::string& up) { return std::string(up.front() == '+' ? "-" : "+") + up.back(); }

Matrix4 place(const Positions& object_positions, const Placement& placement, double lowest_z_m) {
  const Matrix3 turn = Eigen::AngleAxisd(placement.rotate_rad, Vector3::UnitZ()).toRotationMatrix();
  const Matrix3 rotation =
      placement.rotate_rad == 0.0 ? face_down(placement.face) : Matrix3(turn * face_down(placement.face));
  const Positions turned = object_positions * rotation.transpose();
  const Vector3 low = turned.colwise().minCoeff(), high = turned.colwise().maxCoeff();
  Matrix4 gel_from_object = Matrix4::Identity();
  gel_from_object.topLeftCorner<3, 3>() = rotation;
  gel_from_object(0, 3) = placement.center_x_m - 0.5 * (low.x() + high.x());
  gel_from_object(1, 3) = placement.center_y_m - 0.5 * (low.y() + high.y());
  gel_from_object(2, 3) = lowest_z_m - low.z();
  return gel_from_object;
}

Positions transformed(const Matrix4& target_from_source, const Positions& positions) {
  const Matrix3 rotation = target_from_source.topLeftCorner<3, 3>();
  const Eigen::RowVector3d shift = target_from_source.topRightCorner<3, 1>().transpose();
  return (positions * rotation.transpose()).rowwise() + shift;
}

}  // namespace tacipc
