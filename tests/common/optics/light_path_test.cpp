#include "common/optics/light_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "common/optics/trace.h"
#include "common/sensor/camera_model.h"
#include "tests/common/optics/test_surfaces.h"

namespace tacipc {
namespace light_path_test {

double flat(double, double) { return 0.0; }

/// The surface point that a pixel's centre shows on the plane z = 0.
Vector3 seen_point(const Camera& camera, int column, int row) {
  return {((column + 0.5) / camera.width_px - 0.5) * camera.window_width_m,
          ((row + 0.5) / camera.height_px - 0.5) * camera.window_height_m, 0.0};
}

/// What one light sample sends to one point.
struct Arriving {
  Vector3 direction;
  double irradiance;
};
Arriving light_at(const Vector3& point, const LightSample& sample) {
  const Pack zero{};
  const IncidencePack light = light_path({zero + point.x(), zero + point.y(), zero + point.z()}, sample);
  return {{light.direction.x[3], light.direction.y[3], light.direction.z[3]}, light.irradiance[3]};
}

TEST(LightPath, PointLightFallsWithTheSquareOfTheDistance) {
  // E = I h / (h² + r²)^1.5 on a plane: h = 10: 0.01 I below the light, 0.00353553 I at r = 10.
  const LightSample sample{.position_m = {0.0, 0.0, -10.0}, .emission = Emission::isotropic};
  for (const auto& [r, expected] : {std::pair{0.0, 0.01}, std::pair{10.0, 0.0035355339059327}}) {
    const Arriving light = light_at({r, 0.0, 0.0}, sample);
    EXPECT_NEAR(light.irradiance * light.direction.dot(-Vector3::UnitZ()), expected, 1e-14) << "r = " << r;
  }
}

TEST(LightPath, EmissionFallsWithTheAngleAndIsDarkBehind) {
  LightSample sample{.position_m = {0.0, 0.0, -10.0}, .weight = 0.5};
  // 45° off: cos^m/d² with cos = 0.70711, d² = 200.
  EXPECT_NEAR(light_at({10.0, 0.0, 0.0}, sample).irradiance, 0.5 * std::numbers::sqrt2 / 2.0 / 200.0, 1e-15);
  EXPECT_EQ(light_at({0.0, 0.0, -11.0}, sample).irradiance, 0.0);
  sample.emission = Emission::cosine_power;
  sample.exponent = 4.0;
  EXPECT_NEAR(light_at({10.0, 0.0, 0.0}, sample).irradiance, 0.5 * 0.25 / 200.0, 1e-15);
  EXPECT_EQ(light_at({0.0, 0.0, -11.0}, sample).irradiance, 0.0);
}

TEST(LightPath, SearchesFromTheNeighboursAnswerFindTheSame) {
  // Along a row of pixels with a step of 0.4 mm in it, against a search that begins anew at each.
  Sensor sensor = plain_sensor(1, 1);
  sensor.stack = {.gel_thickness_m = 2.0 * kMm, .gel_ior = 1.41, .layers = {{.thickness_m = 5.0 * kMm, .ior = 1.49}}};
  sensor.leds = {{.position_m = {0.01, 0.002, -0.013}, .size_m = {0.005, 0.005}}};
  for (const LightSample& sample : light_samples(sensor, 3)) {
    ASSERT_TRUE(sample.stack);
    PathStart start;
    for (int first = 0; first < 640; first += kLanes) {
      Pack3 point{};
      for (int l = 0; l < kLanes; ++l) {
        point.x[l] = (first + l - 320) * 25e-6;
        point.y[l] = 4e-3;
        point.z[l] = first + l < 300 ? -0.1e-3 : -0.5e-3 + 1e-7 * l;
      }
      const IncidencePack warm = light_path(point, sample, &start), cold = light_path(point, sample);
      for (int l = 0; l < kLanes; ++l) {
        ASSERT_NEAR(warm.irradiance[l] / cold.irradiance[l], 1.0, 1e-9) << first + l;
        ASSERT_NEAR(warm.direction.x[l], cold.direction.x[l], 1e-10) << first + l;
        ASSERT_NEAR(warm.direction.z[l], cold.direction.z[l], 1e-10) << first + l;
        ASSERT_NEAR(warm.length[l] / cold.length[l], 1.0, 1e-10) << first + l;
      }
    }
  }
}

TEST(LightSamples, CoverTheSquareAndShareTheIntensity) {
  Sensor sensor = plain_sensor(1, 1);
  sensor.leds = {{.position_m = {0.01, 0.0, -0.013}, .size_m = {0.005, 0.005}}};
  const auto samples = light_samples(sensor, 3);
  ASSERT_EQ(samples.size(), 9u);
  Vector3 mean = Vector3::Zero();
  double weight = 0.0, reach = 0.0;
  for (const LightSample& sample : samples) {
    mean += sample.position_m / 9.0;
    weight += sample.weight;
    reach = std::max(reach, std::abs(sample.position_m.x() - 0.01));
    EXPECT_DOUBLE_EQ(sample.position_m.z(), -0.013);
  }
  EXPECT_LT((mean - sensor.leds[0].position_m).norm(), 1e-15);
  EXPECT_NEAR(weight, 1.0, 1e-15);
  EXPECT_NEAR(reach, 0.005 / 3.0, 1e-15);
  sensor.leds = {point_light({0.0, 0.0, -0.01})};
  EXPECT_EQ(light_samples(sensor, 3).size(), 1u);
}

TEST(LightSources, GaussPointsIntegrateWhatTheGridOnlyNears) {
  Sensor sensor = plain_sensor(1, 1);
  const double side = 5e-3;
  sensor.leds = {{.position_m = {0.01, 0.0, -0.013}, .size_m = {side, side}}};
  sensor.leds[0].intensity = 2.0;
  const LightSource source = light_sources(sensor, 3).front();
  ASSERT_EQ(source.grid.size(), 9u);
  ASSERT_EQ(source.in_sight.size(), 4u);
  const auto moment = [](const std::vector<LightSample>& samples, int power) {
    double sum = 0.0;
    for (const LightSample& sample : samples) sum += sample.weight * std::pow(sample.position_m.x() - 0.01, power);
    return sum;
  };
  // ∫ x² over the square is a²/12; midpoints of thirds give 8/9 of that.
  EXPECT_NEAR(moment(source.in_sight, 0), 2.0, 1e-15);
  EXPECT_NEAR(moment(source.in_sight, 2), 2.0 * side * side / 12.0, 1e-18);
  EXPECT_NEAR(moment(source.grid, 2), 2.0 * side * side / 12.0 * 8.0 / 9.0, 1e-18);
  // Three points along an edge are exact to the fifth degree: ∫ x⁴ is a⁴/80.
  const LightSource finer = light_sources(sensor, 5).front();
  ASSERT_EQ(finer.in_sight.size(), 9u);
  EXPECT_NEAR(moment(finer.in_sight, 4) / (2.0 * std::pow(side, 4) / 80.0), 1.0, 1e-12);
}

TEST(LightSources, NarrowBeamsSharpLobesAndDiffusersKeepTheGrid) {
  Sensor sensor = plain_sensor(1, 1);
  sensor.leds = {{.position_m = {0.01, 0.0, -0.013}, .size_m = {5e-3, 5e-3}}};
  ASSERT_FALSE(light_sources(sensor, 3).front().in_sight.empty());
  EXPECT_TRUE(light_sources(sensor, 2).front().in_sight.empty());  // as many points
  Sensor other = sensor;
  other.leds[0].emission = Emission::cosine_power;
  EXPECT_TRUE(light_sources(other, 3).front().in_sight.empty());
  other = sensor;
  other.coating.specular_f0 = 0.04;
  other.coating.ggx_alpha = 0.1;
  EXPECT_TRUE(light_sources(other, 3).front().in_sight.empty());
  other.coating.ggx_alpha = 0.4;
  EXPECT_FALSE(light_sources(other, 3).front().in_sight.empty());
  other.leds[0].size_m = {0.0, 0.0};
  EXPECT_TRUE(light_sources(other, 3).front().in_sight.empty());
}

TEST(LightSources, NoLightArrivesBelowTheLeastElevation) {
  Sensor sensor = plain_sensor(1, 1);
  sensor.leds = {{.position_m = {0.01, 0.002, -0.013}, .size_m = {5e-3, 3e-3}}};
  const Vector3 low(-7.5e-3, -5.6e-3, -1.2e-3), high(7.5e-3, 5.6e-3, 1e-5);
  for (const bool refracts : {false, true}) {
    for (const bool tilted : {false, true}) {
      if (refracts)
        sensor.stack = {
            .gel_thickness_m = 2.0 * kMm, .gel_ior = 1.41, .layers = {{.thickness_m = 5.0 * kMm, .ior = 1.49}}};
      sensor.leds[0].normal = tilted ? Vector3(-0.6, 0.0, 0.8) : Vector3::UnitZ();
      const LightSource source = light_sources(sensor, 3).front();
      const double bound = least_squared_elevation(source, sensor, low, high);
      double least = 1e9;
      for (const LightSample& sample : light_samples(sensor, 16)) {
        for (int i = 0; i < 27; ++i) {
          const int row = i / 3 % 3, layer = i / 9;
          const Vector3 share(i % 3 / 2.0, row / 2.0, layer / 2.0);
          const Vector3 w = light_at(low + share.cwiseProduct(high - low), sample).direction;
          least = std::min(least, w.z() * w.z() / w.head<2>().squaredNorm());
        }
      }
      EXPECT_GE(least, bound);
      EXPECT_GT(bound, 0.6 * least) << "refracts " << refracts << ", tilted " << tilted;
    }
  }
  // A light beside the gel shines along it.
  sensor.stack = {};
  sensor.leds[0].position_m.z() = -1e-3;
  EXPECT_EQ(least_squared_elevation(light_sources(sensor, 3).front(), sensor, low, high), 0.0);
}

TEST(Trace, WhatIsInFullSightIsNearerToTheIntegralThanTheGridIs) {
  Sensor sensor = plain_sensor(4, 3);
  sensor.stack = {.gel_thickness_m = 2.0 * kMm, .gel_ior = 1.41, .layers = {{.thickness_m = 5.0 * kMm, .ior = 1.49}}};
  sensor.coating.specular_f0 = 0.04;
  sensor.coating.ggx_alpha = 0.4;
  sensor.leds = {{.position_m = {0.01, 0.002, -0.013}, .size_m = {5e-3, 5e-3}}};
  Sensor gridded = sensor;
  gridded.leds[0].emission = Emission::cosine_power;  // of exponent 1: the same light, as a grid
  const Membrane plane = height_field(4e-3, 4e-3, 1e-3, flat);
  const TraceResult exact = trace(plane, gridded, {.subpixels = 1, .led_samples = 16});
  const TraceResult grid = trace(plane, gridded, {.subpixels = 1, .led_samples = 3});
  const TraceResult gauss = trace(plane, sensor, {.subpixels = 1, .led_samples = 3});
  for (const auto image : {&TraceResult::basis, &TraceResult::gloss}) {
    double of_grid = 0.0, of_gauss = 0.0;
    for (std::size_t i = 0; i < (exact.*image).pixels.size(); ++i) {
      const double truth = (exact.*image).pixels[i];
      of_grid += std::pow((grid.*image).pixels[i] - truth, 2.0);
      of_gauss += std::pow((gauss.*image).pixels[i] - truth, 2.0);
    }
    EXPECT_LT(std::sqrt(of_gauss), 0.5 * std::sqrt(of_grid));
  }
}

TEST(Trace, PlaneUnderAPointLightMatchesTheFormula) {
  Sensor sensor = plain_sensor(20, 15);
  const Vector3 light(3.0 * kMm, -1.0 * kMm, -10.0 * kMm);
  sensor.leds = {point_light(light)};
  const TraceResult result = trace(height_field(4e-3, 4e-3, 5e-4, flat), sensor, {.subpixels = 1});
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 20; ++column) {
      const Vector3 to_light = light - seen_point(sensor.camera, column, row);
      const double expected = 10.0 * kMm / std::pow(to_light.squaredNorm(), 1.5) / std::numbers::pi;
      EXPECT_NEAR(result.basis.at(column, row, 0) / expected, 1.0, 1e-5) << column << ", " << row;
    }
  }
  EXPECT_EQ(result.outside_rays, 0);
}

TEST(Trace, AreaLightOfManySamplesConvergesToTheIntegral) {
  // A square of side a = 5 at h = 10 mm, Lambertian, seen from the axis point: 1/π ∫ h²/(h² + x² + y²)² dx dy / a².
  constexpr double kSide = 5e-3, kHeight = 1e-2;
  constexpr int kSteps = 400;
  double integral = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double x = kSide * ((i + 0.5) / kSteps - 0.5), y = kSide * ((j + 0.5) / kSteps - 0.5);
      integral += kHeight * kHeight / std::pow(kHeight * kHeight + x * x + y * y, 2.0) / (kSteps * kSteps);
    }
  }
  Sensor sensor = plain_sensor(1, 1);
  sensor.leds = {{.position_m = {0.0, 0.0, -kHeight}, .rgb = {1, 1, 1}, .size_m = {kSide, kSide}}};
  const Membrane plane = height_field(4e-3, 4e-3, 1e-3, flat);
  const auto error = [&](int samples) {
    return trace(plane, sensor, {.subpixels = 1, .led_samples = samples}).basis.at(0, 0, 0) * std::numbers::pi /
               integral -
           1.0;
  };
  EXPECT_LT(std::abs(error(3)), 2e-3);               // Gauss's points
  sensor.leds[0].emission = Emission::cosine_power;  // of exponent 1: the same light, as a grid
  EXPECT_LT(std::abs(error(3)), 0.01);
  EXPECT_NEAR(error(2) / error(4), 4.0, 0.3);  // midpoint rule: second order
}

TEST(Trace, LightAddsUpAndDoubles) {
  Sensor sensor = plain_sensor(24, 18);
  sensor.leds = {point_light({8e-3, 2e-3, -9e-3}), point_light({-5e-3, 7e-3, -11e-3})};
  sensor.leds[0].rgb = {1.0, 0.25, 0.0};
  sensor.leds[1].rgb = {0.0, 0.5, 2.0};
  const Membrane ball = height_field(4e-3, 4e-3, 1e-4, ball_press);
  const FloatImage both = color_image(trace(ball, sensor, {}).basis, sensor);
  FloatImage sum(both.width, both.height, 3);
  for (const Led& led : sensor.leds) {
    Sensor alone = sensor;
    alone.leds = {led};
    const FloatImage image = color_image(trace(ball, alone, {}).basis, alone);
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
  }
  const float brightest = *std::max_element(both.pixels.begin(), both.pixels.end());
  EXPECT_LT(largest_difference(both, sum), 1e-6 * brightest);

  Sensor doubled = sensor;
  for (Led& led : doubled.leds) {
    for (double& channel : led.rgb) channel *= 2.0;
  }
  FloatImage twice = color_image(trace(ball, doubled, {}).basis, doubled);
  for (float& value : twice.pixels) value *= 0.5f;
  EXPECT_EQ(largest_difference(both, twice), 0.0);
}

TEST(ColorImage, MultipliesAlbedoAndAddsAmbient) {
  Sensor sensor = plain_sensor(1, 1);
  sensor.coating.albedo = {0.5, 0.25, 1.0};
  sensor.ambient_rgb = {0.0, 1.0, 0.5};
  sensor.leds = {point_light(Vector3::Zero()), point_light(Vector3::Zero())};
  sensor.leds[1].rgb = {2.0, 0.0, 4.0};
  FloatImage basis(1, 1, 2);
  basis.at(0, 0, 0) = 3.0f;
  basis.at(0, 0, 1) = 5.0f;
  const FloatImage image = color_image(basis, sensor);
  EXPECT_FLOAT_EQ(image.at(0, 0, 0), 0.5f * (3.0f + 10.0f));
  EXPECT_FLOAT_EQ(image.at(0, 0, 1), 0.25f * 3.0f + 1.0f);
  EXPECT_FLOAT_EQ(image.at(0, 0, 2), 23.0f + 0.5f);
}

TEST(Trace, QuarterTurnOfTheLightTurnsTheImage) {
  Sensor sensor = plain_sensor(32, 32);
  sensor.camera.window_height_m = sensor.camera.window_width_m;
  for (int k = 0; k < 4; ++k) {
    const double azimuth = k * std::numbers::pi / 2.0;
    sensor.leds.push_back({.position_m = {8e-3 * std::cos(azimuth), 8e-3 * std::sin(azimuth), -9e-3},
                           .rgb = {1, 1, 1},
                           .size_m = {5e-3, 5e-3}});
  }
  const FloatImage basis = trace(height_field(4e-3, 4e-3, 1e-4, ball_press), sensor, {}).basis;
  const float brightest = *std::max_element(basis.pixels.begin(), basis.pixels.end());
  for (int k = 1; k < 4; ++k) {
    double most = 0.0;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        // x → −y, y → x is a quarter turn from x towards y.
        int u = x, v = y;
        for (int turn = 0; turn < k; ++turn) std::tie(u, v) = std::pair(31 - v, u);
        most = std::max(most, std::abs(static_cast<double>(basis.at(x, y, 0)) - basis.at(u, v, k)));
      }
    }
    EXPECT_LT(most, 1e-5 * brightest) << "quarter turns: " << k;
  }
}

TEST(Trace, SlopesThatFaceTheLightAreBright) {
  Sensor sensor = plain_sensor(40, 30);
  sensor.leds = {point_light({8e-3, 8e-3, -9e-3})};  // azimuth 45°: right and down in the image
  const FloatImage basis = trace(height_field(4e-3, 4e-3, 1e-4, ball_press), sensor, {}).basis;
  // The press bulges towards camera and light, so its side to the right and below faces the light.
  EXPECT_GT(basis.at(28, 23, 0), 1.3f * basis.at(11, 6, 0));
}

}  // namespace light_path_test
}  // namespace tacipc
