#include "common/sensor/camera_description.h"

#include "common/base/error.h"
#include "common/base/packed_units.h"
#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

constexpr const char* kModels[] = {"pinhole", "fisheye", "rectified"};

template <typename Matrix>
Value::List rows_of(const Matrix& matrix) {
  Value::List rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Value::List row;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.emplace_back(matrix(i, j) + 0.0);  // avoids negative zero
    rows.emplace_back(std::move(row));
  }
  return rows;
}

}  // namespace

Value::Map describe_camera(const Sensor& sensor) {
  const Camera& camera = sensor.camera;
  const CameraModel model(camera, sensor.stack);
  const double column = 0.5 * camera.width_px, row = 0.5 * camera.height_px;
  const auto on_plane = [&](double dx, double dy) -> Eigen::Vector2d {
    const auto point = model.on_plane(column + dx, row + dy);
    if (!point) throw DataError("sensor {}: the middle of the camera's image does not see the gel", sensor.name);
    return kMmPerM * *point;
  };
  const Eigen::Vector2d along_x = on_plane(0.5, 0.0) - on_plane(-0.5, 0.0);
  const Eigen::Vector2d along_y = on_plane(0.0, 0.5) - on_plane(0.0, -0.5);
  Matrix4 s_from_camera = Matrix4::Identity();
  s_from_camera.topLeftCorner<3, 3>() = model.s_from_camera();
  s_from_camera.topRightCorner<3, 1>() = kMmPerM * camera.position_m;
  Value::Map lines{{"camera_model", kModels[static_cast<int>(camera.model)]},
                   {"width_px", camera.width_px},
                   {"height_px", camera.height_px},
                   {"window_mm", Value::List{kMmPerM * camera.window_width_m, kMmPerM * camera.window_height_m}},
                   {"mm_per_px", Value::List{along_x.norm(), along_y.norm()}},
                   {"T_S_camera", rows_of(s_from_camera)}};
  if (camera.model == Camera::Model::rectified) {
    Matrix3 plane = Matrix3::Identity();
    plane.block<2, 1>(0, 0) = along_x;
    plane.block<2, 1>(0, 1) = along_y;
    plane.block<2, 1>(0, 2) = on_plane(0.0, 0.0) - column * along_x - row * along_y;
    lines.emplace_back("plane_from_pixel", rows_of(plane));
    lines.emplace_back("K_absent", "a rectified camera has no single pinhole; use plane_from_pixel");
    return lines;
  }
  const auto& [fx, fy, cx, cy] = model.intrinsics_px();
  Matrix3 k;
  k << fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0;
  lines.emplace_back("K", rows_of(k));
  lines.emplace_back("distortion_radial", Value::List(camera.radial.begin(), camera.radial.end()));
  lines.emplace_back("distortion_tangential", Value::List(camera.tangential.begin(), camera.tangential.end()));
  lines.emplace_back("plane_from_pixel_absent",
                     "only a rectified camera maps the plane linearly; use K and T_S_camera");
  return lines;
}

}  // namespace tacipc
