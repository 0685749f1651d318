#include "stages/image/calibrate/fit_metallic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

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
    EXPECT_EQ(ball.ball(row, 0) != ball.empty(row, 0), r < 1.658e-3) << x << ", " << y;
  }
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

}  // namespace
}  // namespace tacipc
