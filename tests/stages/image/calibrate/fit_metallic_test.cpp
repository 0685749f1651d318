#include "stages/image/calibrate/fit_metallic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sensor/camera_model.h"

namespace tacipc {
namespace fit_metallic_test {

Sensor small_sensor() {
  Sensor sensor;
  sensor.camera = {.position_m = {0.0, 0.0, -49e-3},
                   .width_px = 60,
                   .height_px = 60,
                   .window_width_m = 12e-3,
                   .window_height_m = 12e-3};
  return sensor;
}

MetallicLamps lamps_of(double factor, const std::array<std::array<double, 3>, 2>& rgb) {
  return {.change_factor = factor,
          .lamps = {{.position_m = {25e-3, -14e-3, -11e-3}, .rgb = rgb[0]},
                    {.position_m = {-25e-3, -10e-3, -11e-3}, .rgb = rgb[1]}}};
}

/// A ball of 3 mm about (x, 0), 0.5 mm deep, at every pixel; photographed under `light`.
MetallicSamples photographed(double x_m, const MetallicLamps& light) {
  Samples samples;
  for (int y = 0; y < 60; y += 2)
    for (int x = 0; x < 60; x += 2) samples.pixels.push_back({x, y});
  const auto rows = static_cast<Eigen::Index>(samples.pixels.size());
  samples.target = Codes::Zero(rows, 3);
  samples.used = Codes::Ones(rows, 3);
  MetallicSamples out = metallic_samples(samples, {x_m, 0.0, 2.5e-3}, 3e-3, light.lamps, small_sensor());
  for (Eigen::Index i = 0; i < rows; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      out.samples.target(i, static_cast<Eigen::Index>(c)) = metallic_change(out, light, i, c);
  return out;
}

TEST(MetallicSamples, TheBallIsSeenWhereItIsInTheGel) {
  const MetallicLamps lamps = lamps_of(0.5, {{{1, 0, 0}, {0, 1, 0}}});
  const MetallicSamples ball = photographed(0.0, lamps);
  // It meets the front √(9 − 6.25) mm = 1.658 mm from its axis; pixels are 0.2 mm.
  for (std::size_t i = 0; i < ball.samples.pixels.size(); ++i) {
    const auto [x, y] = ball.samples.pixels[i];
    const double r = 0.2e-3 * std::hypot(x - 29.5, y - 29.5);
    if (std::abs(r - 1.658e-3) < 0.03e-3) continue;  // perspective shifts the edge a little
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_EQ(ball.object(row, 0) != ball.empty(row, 0), r < 1.658e-3) << x << ", " << y;
  }
}

// The same ball as a map of its height on the camera's rays: equal light but at its rim, where the map has a kink.
TEST(MetallicSamples, AHeightMapIsTheObjectItself) {
  const MetallicLamps lamps = lamps_of(0.5, {{{1, 0, 0}, {0, 1, 0}}});
  const MetallicSamples ball = photographed(0.0, lamps);
  FloatImage height(60, 60, 1);
  const CameraModel camera(small_sensor().camera, small_sensor().stack);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) {
      const CameraRay ray = camera.ray(x + 0.5, y + 0.5).value();
      const Vector3 to_ball = Vector3(0.0, 0.0, 2.5e-3) - ray.origin;
      const double along = to_ball.dot(ray.direction), squared = along * along - to_ball.squaredNorm() + 9e-6;
      const double z = squared > 0.0 ? (ray.origin + (along - std::sqrt(squared)) * ray.direction).z() : 0.0;
      height.at(x, y, 0) = static_cast<float>(std::max(0.0, -z));
    }
  const MetallicSamples map = metallic_samples(ball.samples, height, lamps.lamps, small_sensor());
  EXPECT_EQ(map.empty, ball.empty);
  int inside = 0;
  for (std::size_t i = 0; i < ball.samples.pixels.size(); ++i) {
    const auto [x, y] = ball.samples.pixels[i];
    const auto row = static_cast<Eigen::Index>(i);
    if (std::hypot(x - 29.5, y - 29.5) > 7.0) {
      if (height.at(x, y, 0) == 0.0F) {
        EXPECT_EQ(map.object(row, 0), ball.empty(row, 0));
      }
      continue;
    }
    ++inside;
    // Some of it is lit at a grazing angle: the error counts beside the light of the flat front.
    for (const Eigen::Index l : {0, 1}) EXPECT_NEAR(map.object(row, l), ball.object(row, l), 0.02 * ball.empty(row, l));
  }
  EXPECT_GT(inside, 30);
}

TEST(FitMetallic, ColoursAndFactorThatMadeThePhotographsComeBack) {
  const MetallicLamps truth = lamps_of(1.3, {{{2.0, 0.3, 0.1}, {0.2, 0.6, 1.5}}});
  const std::vector<MetallicSamples> balls{photographed(-2e-3, truth), photographed(2e-3, truth)};
  const MetallicLamps start = lamps_of(0.5, {{{1, 0, 0}, {0, 0, 1}}});
  EXPECT_GT(metallic_rmse(balls, start), 3.0);
  const MetallicLamps fitted = fit_metallic(balls, start);
  EXPECT_LT(metallic_rmse(balls, fitted), 0.05);
  // Below white the factor and the colours' common size are one: factor × colour^(1/2.2).
  const auto strength = [](const MetallicLamps& lamps, std::size_t l, std::size_t c) {
    return lamps.change_factor * std::pow(lamps.lamps[l].rgb[c], 1.0 / 2.2);
  };
  for (std::size_t l = 0; l < 2; ++l)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(strength(fitted, l, c), strength(truth, l, c), 0.01);
}

}  // namespace fit_metallic_test
}  // namespace tacipc
