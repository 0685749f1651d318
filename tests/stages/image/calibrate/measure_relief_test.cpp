#include "stages/image/calibrate/measure_relief.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/optics/seen_membrane.h"

namespace tacipc {
namespace measure_relief_test {

constexpr int kSide = 121;  // vertices of the front, 0.1 mm apart

Sensor sensor() {
  Sensor out;
  out.camera = {.position_m = {0, 0, -49e-3},
                .width_px = 100,
                .height_px = 100,
                .window_width_m = 10e-3,
                .window_height_m = 10e-3};
  return out;
}

/// A block of 4 × 4 mm pressed to a depth, its walls at 45°.
Positions block(double depth) {
  Positions front(kSide * kSide, 3);
  for (int i = 0; i < kSide * kSide; ++i) {
    const int row = i / kSide;
    const double x = 1e-4 * (i % kSide - 60), y = 1e-4 * (row - 60);
    const double beside = std::max(std::abs(x), std::abs(y)) - 2e-3;
    front.row(i) << x, y, -std::clamp(depth - beside, 0.0, depth);
  }
  return front;
}

KnownObject pressed_block() {
  KnownObject object;
  object.front = block(0.8e-3);
  object.front_before = block(0.5e-3);
  object.origin_z_m = -0.8e-3;  // in its lowest point
  object.origin_z_before_m = -0.5e-3;
  object.x_m = 0.3e-3;
  object.y_m = -0.1e-3;
  object.yaw_rad = 0.2;
  object.known.box_px = {10, 10, 80, 80};
  object.triangles.resize(2 * (kSide - 1) * (kSide - 1), 3);
  for (int j = 0, t = 0; j + 1 < kSide; ++j)
    for (int i = 0; i + 1 < kSide; ++i) {
      const int a = kSide * j + i;
      object.triangles.row(t++) << a, a + 1, a + kSide + 1;
      object.triangles.row(t++) << a, a + kSide + 1, a + kSide;
    }
  object.view = view_object(object, sensor());
  return object;
}

TEST(MeasureRelief, FindsTheLayersOfAPrintWhereItTouches) {
  KnownObject object = pressed_block();
  // A dome that lights each channel from another side.
  LightField light{
      .geometry = {.shadow_softness = 0.1, .dome = {.azimuths = 3, .elevation_tan = {0.0}}, .field_half_width_m = 5e-3},
      .weights = {},
      .blur_px = 0.0};
  light.weights = Eigen::MatrixXd::Zero(light.geometry.num_features(), 3);
  for (Eigen::Index c = 0; c < 3; ++c) light.weights(3 * c, c) = 150.0;
  // The print: layers 1.3 mm apart along the object's x.
  PrintRelief made{.map = FloatImage(100, 100, 3), .pixel_m = 1e-4};
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) made.map.at(x, y, 1) = 0.04f * static_cast<float>(std::sin(x / 2.0));
  MembraneView printed = object.view;
  apply_relief(made, {object.x_m, object.y_m, object.yaw_rad, -0.8e-3}, printed);
  const ByteImage background(100, 100, 3, 120);
  object.samples.drift = {0.0, 0.0, 0.0};
  const PrintRelief found =
      measure_relief(object, add_change(background, code_change(light, printed)), background, light, sensor(), 0.05);
  double along = 0.0, squares = 0.0;
  int known = 0, outside = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      const bool face = std::max(std::abs(x - 49.5), std::abs(y - 49.5)) < 17;  // 3.4 mm of the 4 mm
      if (!face) {
        // Beyond the edge of the press before, the membrane need not be the object.
        if (std::max(std::abs(x - 49.5), std::abs(y - 49.5)) > 27) outside += found.map.at(x, y, 0) < 1.0f;
        continue;
      }
      known += found.map.at(x, y, 0) < 1.0f;
      along += double{found.map.at(x, y, 1)} * double{made.map.at(x, y, 1)};
      squares += double{made.map.at(x, y, 1)} * double{made.map.at(x, y, 1)};
      EXPECT_NEAR(found.map.at(x, y, 2), 0.0, 0.02) << x << ' ' << y;
    }
  EXPECT_EQ(known, 34 * 34);
  EXPECT_EQ(outside, 0);
  EXPECT_NEAR(along / squares, 1.0, 0.15);  // held a little by its prior
}

TEST(MeasureRelief, WithoutAnEarlierPressIsUnknown) {
  KnownObject object = pressed_block();
  object.front_before.resize(0, 3);
  const LightField light{.geometry = {.shadow_softness = 0.1, .environment_degree = 1, .field_half_width_m = 5e-3},
                         .weights = Eigen::MatrixXd::Constant(6, 3, 10.0),
                         .blur_px = 0.0};
  const ByteImage grey(100, 100, 3, 120);
  const PrintRelief found = measure_relief(object, grey, grey, light, sensor(), 0.05);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) EXPECT_EQ(found.map.at(x, y, 0), 1.0f);
}

}  // namespace measure_relief_test
}  // namespace tacipc
