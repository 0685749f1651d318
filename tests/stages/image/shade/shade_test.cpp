#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/optics/seen_membrane.h"
#include "stages/image/shade/fit_place.h"
#include "tests/config_text.h"
#include "tests/program_test.h"

namespace tacipc {
namespace shade_test {

Sensor sensor() {
  Sensor out;
  out.camera = {
      .position_m = {0, 0, -49e-3}, .width_px = 80, .height_px = 60, .window_width_m = 8e-3, .window_height_m = 6e-3};
  return out;
}

/// A press by a block with soft edges, wider along x: 60 × 60 squares of 0.1 mm about the origin.
FrontFrames block_press() {
  FrontFrames press;
  Positions rest(61 * 61, 3), pressed;
  for (int i = 0; i < 61 * 61; ++i) rest.row(i) << 1e-4 * (i % 61 - 30), 1e-4 * (i / 61 - 30), 0.0;
  pressed = rest;
  for (Eigen::Index i = 0; i < rest.rows(); ++i) {
    const double u = std::abs(rest(i, 0)) / 1.2e-3, v = std::abs(rest(i, 1)) / 0.6e-3;
    pressed(i, 2) = -0.4e-3 / (1.0 + std::pow(u, 6) + std::pow(v, 6));
  }
  press.frames = {rest, pressed};
  press.gel_from_object.assign(2, Matrix4::Identity());
  press.triangles.resize(2 * 60 * 60, 3);
  for (int j = 0, t = 0; j < 60; ++j)
    for (int i = 0; i < 60; ++i) {
      const int a = 61 * j + i;
      press.triangles.row(t++) << a, a + 1, a + 62;
      press.triangles.row(t++) << a, a + 62, a + 61;
    }
  return press;
}

LightField light() {
  LightField out{.geometry = {.lamps_m = {{30e-3, 5e-3, -12e-3}, {-12e-3, 25e-3, -12e-3}},
                              .shadow_softness = 0.2,
                              .field_half_width_m = 4e-3},
                 .weights = {},
                 .blur_px = 0.8};
  out.weights = Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(out.geometry.num_features(), 3);
  out.weights.row(0) << 80, 10, -20;
  out.weights.row(6) << -10, 30, 70;
  return out;
}

TEST(FitPlace, FindsCentreAndYawAndIgnoresDrift) {
  const FrontFrames press = block_press();
  const ByteImage background(80, 60, 3, 120);
  const ImagePlace truth{.x_px = 41.3, .y_px = 27.6, .yaw_rad = 3.0 * std::numbers::pi / 180};
  FloatImage change =
      code_change(light(), view_membrane(at_place(press.frames[1], truth, sensor()), press.triangles, sensor()));
  for (float& code : change.pixels) code += 5.0f;
  const ByteImage photograph = add_change(background, change);
  const PlaceFit fit{.image = "x", .box_px = {20, 12, 42, 34}, .yaw = true};
  const FittedPlace found =
      fit_place(press, 1, {.x_px = 40, .y_px = 29, .yaw_rad = 0}, fit, photograph, background, light(), sensor());
  EXPECT_NEAR(found.place.x_px, truth.x_px, 0.05);
  EXPECT_NEAR(found.place.y_px, truth.y_px, 0.05);
  EXPECT_NEAR(found.place.yaw_rad * 180 / std::numbers::pi, 3.0, 0.15);
  EXPECT_LT(found.rmse_after, 0.6);  // rounding twice leaves 0.41
  EXPECT_GT(found.rmse_before, 5.0);
  PlaceFit straight = fit;
  straight.yaw = false;
  EXPECT_EQ(
      fit_place(press, 1, {.x_px = 40, .y_px = 29, .yaw_rad = 0}, straight, photograph, background, light(), sensor())
          .place.yaw_rad,
      0.0);
}

TEST(PlacePose, IsTheMotionOfTheFront) {
  const ImagePlace place{.x_px = 12, .y_px = 50, .yaw_rad = 0.4};
  Positions p(1, 3);
  p << 1e-3, 2e-3, -3e-4;
  const Vector3 by_pose = (place_pose(place, sensor()) * Vector3(p.row(0)).homogeneous()).head<3>();
  EXPECT_NEAR((at_place(p, place, sensor()).row(0).transpose() - by_pose).norm(), 0.0, 1e-15);
  // The middle of pixel (12, 50): (12.5 / 80 − 1/2) · 8 mm, (50.5 / 60 − 1/2) · 6 mm.
  const Vector3 origin = place_pose(place, sensor()).topRightCorner<3, 1>();
  EXPECT_NEAR(origin.x(), -2.75e-3, 1e-15);
  EXPECT_NEAR(origin.y(), 2.05e-3, 1e-15);
}

class ShadeProgram : public ProgramTest {};

TEST_F(ShadeProgram, ShapesGiveImagesOnTheBackground) {
  std::string sensor = read_file(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/gelsight_lab.yaml");
  for (const auto& [from, to] : {std::pair{"width_px: 320", "width_px: 40"}, {"height_px: 320", "height_px: 30"}})
    sensor.replace(sensor.find(from), std::string(from).size(), to);
  scratch_.file("sensor.yaml", sensor);
  scratch_.file("light.yaml", to_yaml(light().to_value()));
  scratch_.file("shade.yaml",
                "images: [{name: flat, frame: 0}, {name: bump, frame: 1}]\nplace: {center_px: [20, 15]}\n");
  write_png(scratch_ / "background.png", ByteImage(40, 30, 3, 120));
  FloatImage bump(40, 30, 1);
  write_exr(scratch_ / "flat.exr", bump, {"Y"});
  bump.at(20, 15, 0) = 1e-4f;
  write_exr(scratch_ / "bump.exr", bump, {"Y"});
  const std::string command = fmt::format(
      "cd '{}' && {}/shade --config shade.yaml --sensor sensor.yaml --light light.yaml --background background.png "
      "--log-level error ",
      (scratch_ / "").string(), TACIPC_BIN_DIR);
  ASSERT_EQ(run_command(command + "--shapes flat.exr bump.exr --out a --threads 1"), 0) << said_;
  ASSERT_EQ(run_command(command + "--shapes flat.exr bump.exr --out b --threads 3"), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "a"), content_hash(scratch_ / "b"));
  EXPECT_EQ(read_png(scratch_ / "a/flat.png", 3).pixels, ByteImage(40, 30, 3, 120).pixels);
  EXPECT_NE(read_png(scratch_ / "a/bump.png", 3).pixels, ByteImage(40, 30, 3, 120).pixels);
  const FloatImage depth = read_exr(scratch_ / "a/depth/bump.exr", {"Y"});
  EXPECT_NEAR(depth.at(20, 15, 0), 48.9e-3f, 1e-8f);
  EXPECT_NEAR(depth.at(3, 4, 0), 49e-3f, 1e-8f);
  EXPECT_EQ(run_command(command + "--shapes flat.exr --out a"), 2);
  EXPECT_EQ(said_, "shade: error: 1 --shapes for 2 images\n");
  EXPECT_EQ(run_command(command + "--out a"), 2);
  EXPECT_EQ(said_, "shade: error: give either --press or --shapes\n");
  write_png(scratch_ / "background.png", ByteImage(40, 31, 3, 120));
  EXPECT_EQ(run_command(command + "--shapes flat.exr bump.exr --out a"), 1);
  EXPECT_EQ(said_, "shade: error: background.png: is 40 x 31 pixels, the sensor's camera has 40 x 30\n");
}

}  // namespace shade_test
}  // namespace tacipc
