// The camera: pixels and rays invert each other, with lens distortion and behind refracting layers.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/sensor/camera_model.h"
#include "common/sensor/layered_path.h"
#include "common/sensor/sensor.h"

namespace tacipc {
namespace camera_model_test {

constexpr double kMm = 1e-3;
constexpr double kDegree = std::numbers::pi / 180.0;

OpticalStack mctac_stack() {
  return {.gel_thickness_m = 2.0 * kMm,
          .gel_ior = 1.41,
          .layers = {{.name = "acrylic", .thickness_m = 5.0 * kMm, .ior = 1.49}}};
}

Camera camera_of(Camera::Model model) {
  return {.position_m = {0.0, 0.0, -12.0 * kMm},
          .width_px = 640,
          .height_px = 480,
          .window_width_m = 15.0 * kMm,
          .window_height_m = 11.25 * kMm,
          .model = model};
}

TEST(CameraModel, RectifiedWindowIsLinearOnThePlane) {
  const CameraModel camera(camera_of(Camera::Model::rectified), mctac_stack());
  for (const auto& [column, row] : {std::pair{0.0, 0.0}, std::pair{640.0, 480.0}, std::pair{100.5, 300.25}}) {
    const Vector3 expected(15.0 * kMm * (column / 640 - 0.5), 11.25 * kMm * (row / 480 - 0.5), 0.0);
    const auto ray = camera.ray(column, row);
    ASSERT_TRUE(ray);
    const Vector3 at_plane = ray->origin - ray->direction * (ray->origin.z() / ray->direction.z());
    EXPECT_LT((at_plane - expected).norm(), 1e-15);
    EXPECT_NEAR(ray->direction.norm(), 1.0, 1e-12);
    const auto back = camera.project(expected);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - Eigen::Vector2d(column, row)).norm(), 1e-9);
  }
}

TEST(CameraModel, PinholeShowsTheWindowsEdgeAndCornersFurtherOut) {
  const CameraModel camera(camera_of(Camera::Model::pinhole), mctac_stack());
  const auto edge = camera.project({7.5 * kMm, 0.0, 0.0});
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->x(), 640.0, 1e-9);
  // Where a linear map would put the corner of the window lies the picture's corner, 400 px out; light bends it 3.7 %.
  const auto corner = camera.project({7.5 * kMm, 5.625 * kMm, 0.0});
  ASSERT_TRUE(corner);
  EXPECT_NEAR((*corner - Eigen::Vector2d(320, 240)).norm() / 400.0, 1.037, 5e-4);
  // 7 mm is seen 37.36° off the axis: f tan θ.
  const auto seven = camera.project({7.0 * kMm, 0.0, 0.0});
  EXPECT_NEAR(std::atan((seven->x() - 320.0) / camera.intrinsics_px()[0]) / kDegree, 37.36, 5e-3);
}

TEST(CameraModel, ProjectionUndoesTheRay) {
  Camera pinhole = camera_of(Camera::Model::pinhole), fisheye = camera_of(Camera::Model::fisheye);
  pinhole.radial = {-0.12, 0.03, 0.0};
  pinhole.tangential = {0.002, -0.001};
  pinhole.rotation_rad = {0.02, -0.03, 0.1};
  fisheye.radial = {0.05, -0.01, 0.0};
  fisheye.rotation_rad = {0.0, 0.02, -0.05};
  Camera turned = camera_of(Camera::Model::rectified);
  turned.rotation_rad = {0.0, 0.0, 0.2};
  for (const Camera& camera : {pinhole, fisheye, turned}) {
    for (const bool refract : {true, false}) {
      const CameraModel model(camera, mctac_stack(), refract);
      for (const auto& [column, row] : {std::pair{5.0, 470.0}, std::pair{320.0, 240.0}, std::pair{600.0, 31.0}}) {
        const auto ray = model.ray(column, row);
        ASSERT_TRUE(ray);
        for (const double z_mm : {0.0, -0.7}) {
          const Vector3 seen = ray->origin + ray->direction * ((z_mm * kMm - ray->origin.z()) / ray->direction.z());
          const auto back = model.project(seen);
          ASSERT_TRUE(back);
          EXPECT_LT((*back - Eigen::Vector2d(column, row)).norm(), 1e-6) << column << " " << z_mm << " " << refract;
        }
      }
    }
  }
}

TEST(CameraModel, FisheyeIsEquidistant) {
  Camera camera = camera_of(Camera::Model::fisheye);
  camera.intrinsics_px = {150.0, 150.0, 320.0, 240.0};
  const CameraModel model(camera, {.gel_thickness_m = 2e-3});
  const auto ray = model.ray(320.0 + 150.0 * 0.6, 240.0);
  EXPECT_NEAR(std::atan2(ray->direction.x(), ray->direction.z()), 0.6, 1e-12);
  EXPECT_FALSE(model.ray(320.0 + 150.0 * 1.6, 240.0));  // beyond 90°: looks away from the gel
}

TEST(CameraModel, IntrinsicsOfOpenCVHaveTheirCentreHalfAPixelBefore) {
  // OpenCV: a point (x, y, z) of the camera's frame is seen at u = fx x/z + cx, and pixel i is centred at u = i.
  const double fx = 500.0, fy = 520.0, cx = 311.3, cy = 247.9;
  Camera camera = camera_of(Camera::Model::pinhole);
  camera.intrinsics_px = {fx, fy, cx + 0.5, cy + 0.5};
  const CameraModel model(camera, {.gel_thickness_m = 2e-3}, false);
  for (const auto& [u, v] : {std::pair{0, 0}, std::pair{311, 248}, std::pair{639, 479}}) {
    const Vector3 along((u - cx) / fx, (v - cy) / fy, 1.0);
    const auto ray = model.ray(u + 0.5, v + 0.5);  // the middle of pixel (u, v)
    ASSERT_TRUE(ray);
    EXPECT_LT((ray->direction - along.normalized()).norm(), 1e-12);
  }
}

TEST(CameraModel, RayIntoAThinnerMediumIsTotallyReflected) {
  const OpticalStack stack{
      .gel_thickness_m = 2e-3, .gel_ior = 1.0, .layers = {{.name = "glass", .thickness_m = 20e-3, .ior = 1.5}}};
  const CameraModel model(camera_of(Camera::Model::fisheye), stack);  // the camera sits in the glass
  EXPECT_TRUE(model.ray(320.0, 240.0));
  Camera wide = camera_of(Camera::Model::fisheye);
  wide.intrinsics_px = {300.0, 300.0, 320.0, 240.0};
  EXPECT_FALSE(CameraModel(wide, stack).ray(320.0 + 300.0 * 0.8, 240.0));  // 45.8° > asin(1/1.5) = 41.8°
}

TEST(Undistort, UndoesDistortion) {
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(-0.6, 0.5)}) {
    const std::array<double, 3> radial = {-0.2, 0.05, 0.01};
    const std::array<double, 2> tangential = {0.003, -0.004};
    const auto back = undistort(distort(point, radial, tangential), radial, tangential);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - point).norm(), 1e-13);
  }
  EXPECT_FALSE(undistort({2.0, 0.0}, {-0.5, 0.0, 0.0}, {}));  // r (1 − r²/2) never gets there
}

}  // namespace camera_model_test
}  // namespace tacipc
