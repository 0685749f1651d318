#include "stages/rival/baseline/object_depth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "common/sensor/camera_model.h"
#include "stages/rival/baseline/deformation.h"
#include "stages/rival/baseline/kernel.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace object_depth_test {

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

Sensor seen_by(const Camera& camera) {
  Sensor sensor;
  sensor.camera = camera;
  return sensor;
}

/// As the camera sees it through nothing.
Raster object_depth(const TriangleMesh& object, const Matrix4& pose, const Camera& camera, const std::string& name) {
  return ObjectCamera(seen_by(camera), ObjectRays::straight).see(object, Positions(), pose, name).depth;
}

Raster front_depth(const Sensor& sensor) { return ObjectCamera(sensor, ObjectRays::straight).front(); }

/// Acrylic between the camera and the gel.
Sensor with_window() {
  Sensor sensor = seen_by(small_camera());
  sensor.stack = {.gel_thickness_m = 4e-3, .gel_ior = 1.41, .layers = {{.thickness_m = 6e-3, .ior = 1.49}}};
  return sensor;
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

TEST(ObjectDepth, RaysBendAtTheWindowAsThoseOfTheOtherStages) {
  // The edge of a square 1 mm behind the front appears where the sensor's own rays meet it.
  const Sensor sensor = with_window();
  const SeenObject seen =
      ObjectCamera(sensor, ObjectRays::refracted).see(square(1.82e-3), Positions(), moved(1e-3, 0, -1e-3), "square");
  const CameraModel camera(sensor.camera, sensor.stack);
  int bent_apart = 0;
  const Raster straight = object_depth(square(1.82e-3), moved(1e-3, 0, -1e-3), sensor.camera, "square");
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const CameraRay ray = camera.ray(x + 0.5, y + 0.5).value();
      const Vector3 p = ray.origin + (-1e-3 - ray.origin.z()) / ray.direction.z() * ray.direction;
      const bool inside = std::abs(p.x() - 1e-3) < 1.82e-3 && std::abs(p.y()) < 1.82e-3;
      EXPECT_EQ(std::isfinite(seen.depth.at(x, y)), inside) << x << ", " << y;
      if (inside) {
        EXPECT_NEAR(seen.depth.at(x, y), 19e-3, 1e-15);
      }
      bent_apart += std::isfinite(straight.at(x, y)) != inside;
    }
  }
  EXPECT_GT(bent_apart, 0) << "bent or not makes no difference here";
}

TEST(ObjectDepth, WithoutACameraEveryDepthAppearsAtItsPlace) {
  const ObjectCamera above(seen_by(small_camera()), ObjectRays::parallel);
  const Raster shallow = above.see(square(1.05e-3), Positions(), moved(0, 0, 0), "square").depth;
  const Raster deep = above.see(square(1.05e-3), Positions(), moved(0, 0, -3e-3), "square").depth;
  int seen = 0;
  for (std::size_t i = 0; i < deep.values.size(); ++i) {
    ASSERT_EQ(std::isfinite(shallow.values[i]), std::isfinite(deep.values[i])) << i;
    if (std::isnan(deep.values[i])) continue;
    ++seen;
    EXPECT_NEAR(deep.values[i], 17e-3, 1e-15);
  }
  // The depth of the press is also known if the deepest point is out of view.
  EXPECT_NEAR(above.see(square(1.05e-3), Positions(), moved(9e-3, 0, -3e-3), "square").pressed_m, 3e-3, 1e-15);
  EXPECT_EQ(above.see(square(1.05e-3), Positions(), moved(0, 0, 1e-3), "square").pressed_m, 0.0);
  EXPECT_EQ(seen, 100) << "ten by ten centres, 0.2 mm apart, lie within 1.05 mm";
}

TEST(ObjectDepth, NormalsAreTheOnesOfTheVerticesInterpolated) {
  TriangleMesh mesh = square(5e-3);
  Positions normals(4, 3);
  normals << -0.6, 0, -0.8, 0.6, 0, -0.8, 0.6, 0, -0.8, -0.6, 0, -0.8;
  const SeenObject seen =
      ObjectCamera(seen_by(small_camera()), ObjectRays::straight).see(mesh, normals, moved(0, 0, 0), "square");
  for (const int x : {3, 20, 37}) {
    const double along = (-2.9e-3 + 0.2e-3 * x) / 5e-3;  // −1 … 1 over the square
    const Vector3 expected = Vector3(0.6 * along, 0.0, -0.8).normalized();
    EXPECT_NEAR((seen.normal[static_cast<std::size_t>(11 * 40 + x)] - expected).norm(), 0.0, 1e-12);
  }
}

TEST(ObjectDepth, AnObjectInTheWindowIsRefused) {
  EXPECT_EQ(message_of<DataError>([] {
              ObjectCamera(with_window(), ObjectRays::refracted)
                  .see(square(1e-3), Positions(), moved(0, 0, -4e-3), "coin.stl");
            }),
            "coin.stl: the object reaches the camera");
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
  const DeformationConfig half = config.scaled_to(320, 1e-4);
  EXPECT_EQ(half.near_kernel.size_px, 11);
  EXPECT_EQ(half.far_kernel.size_px, 26);
  EXPECT_EQ(half.near_kernel.sigma_px, 3.5);
  EXPECT_EQ(config.scaled_to(640, 1e-4).far_kernel.size_px, 52);
  config.designed_width_px.reset();
  EXPECT_EQ(config.scaled_to(320, 1e-4).near_kernel.size_px, 21);
  const auto older = config_from_text<BaselineConfig>(
      "{deformation: {method: exponential_kernel, designed_width_px: 640}, texture_sigma_mm: 0}", "b.yaml");
  EXPECT_EQ(older.deformation.scaled_to(640, 1e-4).exponential_factor, 1.0);
  EXPECT_EQ(older.deformation.scaled_to(320, 1e-4).exponential_factor, 0.5);
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

}  // namespace object_depth_test
}  // namespace tacipc
