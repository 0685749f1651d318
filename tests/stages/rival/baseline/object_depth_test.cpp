#include "stages/rival/baseline/object_depth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "stages/rival/baseline/deformation.h"
#include "stages/rival/baseline/kernel.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace {

Camera small_camera() {
  return {.position_m = {1e-3, 0.0, -20e-3},
          .width_px = 40,
          .height_px = 30,
          .window_width_m = 8e-3,
          .window_height_m = 6e-3};
}

/// A square of two triangles at z = 0 of its own frame, edges 2 half long; their shared edge crosses pixel centres.
TriangleMesh square(double half) {
  TriangleMesh mesh;
  mesh.positions.resize(4, 3);
  mesh.positions << -half, -half, 0, half, -half, 0, half, half, 0, -half, half, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

Matrix4 moved(double x, double y, double z) {
  Matrix4 pose = Matrix4::Identity();
  pose.topRightCorner<3, 1>() = Vector3(x, y, z);
  return pose;
}

TEST(ObjectDepth, APlaneIsSeenOnEveryRayAtItsDepth) {
  const Raster depth = object_depth(square(0.1), moved(0, 0, -1e-3), small_camera(), "plane");
  for (const double d : depth.values) EXPECT_NEAR(d, 19e-3, 1e-15);
}

TEST(ObjectDepth, PixelsLieOnTheUndeformedFrontAsTheWindowSays) {
  // Centres are 0.2 mm apart, from −2.9 to 4.9 mm in x and −2.9 to 2.9 in y: a square of ±1.05 mm about the origin.
  const Raster depth = object_depth(square(1.05e-3), moved(0, 0, 0), small_camera(), "square");
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const double px = -2.9e-3 + 0.2e-3 * x, py = -2.9e-3 + 0.2e-3 * y;
      EXPECT_EQ(std::isfinite(depth.at(x, y)), std::abs(px) < 1.05e-3 && std::abs(py) < 1.05e-3) << x << ", " << y;
    }
  }
}

TEST(ObjectDepth, TheNearestSurfaceAndASlantAreExact) {
  TriangleMesh mesh = square(5e-3);
  for (int i = 0; i < 4; ++i) mesh.positions(i, 2) = 0.25 * mesh.positions(i, 0);  // z = x / 4
  const Camera camera = small_camera();
  const Raster depth = object_depth(mesh, moved(0, 0, -2e-3), camera, "slant");
  for (int x = 0; x < 40; ++x) {
    // On the ray (x_p − x_c) t + x_c with t = depth / 20 mm: depth = 18 mm + x / 4.
    const double slope = (-2.9e-3 + 0.2e-3 * x - 1e-3) / 20e-3;
    EXPECT_NEAR(depth.at(x, 7), (18e-3 + 0.25 * 1e-3) / (1.0 - 0.25 * slope), 1e-14);
  }
}

TEST(ObjectDepth, AnObjectAtTheCameraIsRefused) {
  EXPECT_EQ(message_of<DataError>([] { object_depth(square(1.0), moved(0, 0, -20e-3), small_camera(), "coin.stl"); }),
            "coin.stl: the object reaches the camera");
}

TEST(FrontDepth, FlatAndDomed) {
  Sensor sensor;
  sensor.camera = small_camera();
  EXPECT_EQ(front_depth(sensor).at(3, 9), 20e-3);
  sensor.gel.dome_radius_m = 30e-3;
  const Raster depth = front_depth(sensor);
  for (const int x : {0, 17, 39}) {
    const double slope_x = (-2.9e-3 + 0.2e-3 * x - 1e-3) / 20e-3, slope_y = (-2.9e-3 + 0.2e-3 * 4) / 20e-3;
    const double d = depth.at(x, 4);
    const Vector3 p(1e-3 + slope_x * d, slope_y * d, d - 20e-3);
    EXPECT_NEAR((p - Vector3(0, 0, -30e-3)).norm(), 30e-3, 1e-14);
    EXPECT_NEAR(p.z(), sensor.gel.dome_radius_m ? sensor.gel.front_z(p.x(), p.y()) : 0.0, 1e-14);
  }
}

TEST(Protrusion, NothingSeenIsNoContact) {
  Raster depth(3, 1, 10e-3);
  depth.at(1, 0) = std::nan("");
  depth.at(2, 0) = 12e-3;
  const Raster h = protrusion(depth, Raster(3, 1, 11e-3));
  EXPECT_NEAR(h.at(0, 0), 1e-3, 1e-18);
  EXPECT_EQ(h.at(1, 0), 0.0);
  EXPECT_EQ(h.at(2, 0), 0.0);
}

TEST(Kernels, ScaleWithTheWidthAndKeepTheirParity) {
  DeformationConfig config;
  config.near_kernel = {21, 7.0};
  config.far_kernel = {52, 9.0};
  config.designed_width_px = 640;
  const DeformationConfig half = config.scaled_to(320);
  EXPECT_EQ(half.near_kernel.size_px, 11);
  EXPECT_EQ(half.far_kernel.size_px, 26);
  EXPECT_EQ(half.near_kernel.sigma_px, 3.5);
  EXPECT_EQ(config.scaled_to(640).far_kernel.size_px, 52);
  config.designed_width_px.reset();
  EXPECT_EQ(config.scaled_to(320).near_kernel.size_px, 21);
  const auto older = config_from_text<BaselineConfig>(
      "{deformation: {method: exponential_kernel, designed_width_px: 640}, texture_sigma_mm: 0}", "b.yaml");
  EXPECT_EQ(older.deformation.scaled_to(640).exponential_factor, 1.0);
  EXPECT_EQ(older.deformation.scaled_to(320).exponential_factor, 0.5);
  const Raster small = exponential_kernel(0.5), large = exponential_kernel();
  ASSERT_EQ(small.width, 7);
  EXPECT_NEAR(small.at(0, 3) / small.at(3, 3), large.at(0, 6) / large.at(6, 6), 1e-12)
      << "3 pixels are 6 of half the size";
}

TEST(Texture, HasItsDeviationAndDependsOnTheSeedAlone) {
  Raster a(200, 100), b(200, 100), c(200, 100);
  add_texture(a, 2e-6, 1);
  add_texture(b, 2e-6, 1);
  add_texture(c, 2e-6, 2);
  EXPECT_EQ(a.values, b.values);
  EXPECT_NE(a.values, c.values);
  double squares = 0.0;
  for (const double v : a.values) squares += v * v;
  EXPECT_NEAR(std::sqrt(squares / 20000.0), 2e-6, 4e-8);  // one standard error of the deviation is 1e-8
}

}  // namespace
}  // namespace tacipc
