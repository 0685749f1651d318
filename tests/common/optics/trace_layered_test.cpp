// Rendering through layers: refracted light and camera, the coating's lobe, markers, groups, the diffuser.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "common/optics/light_path.h"
#include "common/optics/trace.h"
#include "common/sensor/camera_model.h"
#include "tests/common/optics/test_surfaces.h"

namespace tacipc {
namespace trace_layered_test {

double flat(double, double) { return 0.0; }

/// Gel 2 mm, acrylic 5 mm, then air; camera and lights behind.
Sensor layered_sensor(int width_px, int height_px) {
  Sensor sensor = plain_sensor(width_px, height_px);
  sensor.stack = {
      .gel_thickness_m = 2e-3, .gel_ior = 1.41, .layers = {{.name = "acrylic", .thickness_m = 5e-3, .ior = 1.49}}};
  sensor.camera.model = Camera::Model::rectified;
  return sensor;
}

TEST(Trace, PlaneThroughLayersShowsTheClosedForm) {
  Sensor sensor = layered_sensor(20, 15);
  const Vector3 light(6.0 * kMm, -4.0 * kMm, -10.0 * kMm);
  sensor.leds = {point_light(light)};
  const TraceResult result = trace(height_field(4e-3, 4e-3, 5e-4, flat), sensor, {.subpixels = 1});
  LayerStack stack;
  stack.add(3e-3, 1.0);
  stack.add(5e-3, 1.49);
  stack.add(2e-3, 1.41);
  const CameraModel camera(sensor.camera, sensor.stack);
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 20; ++column) {
      const auto point = camera.on_plane(column + 0.5, row + 0.5);
      const auto path = layered_path<double>(stack, 2e-3, (*point - light.head<2>()).squaredNorm());
      const double to_camera = camera.ray(column + 0.5, row + 0.5)->transmittance;
      const double expected = to_camera * path.transmittance * path.spread / std::numbers::pi;  // E ⊥ z: no cosine
      EXPECT_NEAR(result.basis.at(column, row, 0) / expected, 1.0, 1e-5) << column << ", " << row;
    }
  }
}

TEST(Trace, EqualIndicesRenderAsStraightRaysDo) {
  Sensor sensor = layered_sensor(40, 30);
  sensor.stack.gel_ior = 1.0;
  sensor.stack.layers[0].ior = 1.0;
  sensor.leds = {point_light({8e-3, 2e-3, -9e-3}), {.position_m = {-5e-3, 7e-3, -11e-3}, .size_m = {4e-3, 4e-3}}};
  const Membrane ball = height_field(4e-3, 4e-3, 1e-4, ball_press);
  const TraceResult layered = trace(ball, sensor, {}), straight = trace(ball, sensor, {.refract = false});
  const float brightest = *std::max_element(straight.basis.pixels.begin(), straight.basis.pixels.end());
  // Rays start at the gel's back instead of the camera: in single precision a few meet another triangle of an edge.
  double squared = 0.0, total = 0.0;
  for (std::size_t i = 0; i < layered.basis.pixels.size(); ++i) {
    squared += std::pow(layered.basis.pixels[i] - straight.basis.pixels[i], 2.0);
    total += std::pow(straight.basis.pixels[i], 2.0);
  }
  EXPECT_LT(std::sqrt(squared / total), 1e-5);
  EXPECT_LT(largest_difference(layered.basis, straight.basis), 1e-2 * brightest);
  EXPECT_LT(largest_difference(layered.depth, straight.depth), 1e-7);
}

TEST(Trace, RefractionMakesTheLightSteeperAndTheContrastSmaller) {
  Sensor sensor = layered_sensor(40, 30);
  sensor.leds = {point_light({10e-3, 0.0, -13e-3})};
  const Membrane ball = height_field(4e-3, 4e-3, 1e-4, ball_press);
  const auto contrast = [&](bool refract) {
    const FloatImage basis = trace(ball, sensor, {.refract = refract}).basis;
    return basis.at(29, 15, 0) / basis.at(10, 15, 0);  // the slope towards the light over the one away from it
  };
  EXPECT_GT(contrast(false), 1.05 * contrast(true));
  EXPECT_GT(contrast(true), 1.2);
}

TEST(Trace, QuarterTurnOfTheLightTurnsTheLayeredImage) {
  Sensor sensor = layered_sensor(32, 32);
  sensor.camera.window_height_m = sensor.camera.window_width_m;
  sensor.coating.specular_f0 = 0.05;
  sensor.coating.ggx_alpha = 0.3;
  for (int k = 0; k < 4; ++k) {
    const double azimuth = k * std::numbers::pi / 2.0;
    sensor.leds.push_back({.position_m = {8e-3 * std::cos(azimuth), 8e-3 * std::sin(azimuth), -12e-3},
                           .rgb = {1, 1, 1},
                           .size_m = {5e-3, 5e-3}});
    // Lambertian, but the same points for every place: what counts as full sight goes by a grid that does not turn.
    sensor.leds.back().emission = Emission::cosine_power;
  }
  const TraceResult result = trace(height_field(4e-3, 4e-3, 1e-4, ball_press), sensor, {});
  for (const FloatImage* image : {&result.basis, &result.gloss}) {
    const float brightest = *std::max_element(image->pixels.begin(), image->pixels.end());
    ASSERT_GT(brightest, 0.0f);
    for (int k = 1; k < 4; ++k) {
      double most = 0.0;
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
          int u = x, v = y;
          for (int turn = 0; turn < k; ++turn) std::tie(u, v) = std::pair(31 - v, u);
          most = std::max(most, std::abs(static_cast<double>(image->at(x, y, 0)) - image->at(u, v, k)));
        }
      }
      EXPECT_LT(most, 1e-5 * brightest) << "quarter turns: " << k;
    }
  }
}

TEST(Trace, ShadowOfAStepEndsWhereTheRefractedLightPassesItsEdge) {
  const Membrane step = step_of_1mm();
  Sensor sensor = layered_sensor(400, 3);
  sensor.leds = {point_light({8.0 * kMm, 0.0, -12.0 * kMm})};
  const TraceResult result = trace(step, sensor, {.subpixels = 1});
  // In the gel light runs straight, so the floor point x in line with the edge is the one whose path passes (0, −1).
  LayerStack stack = sensor.stack.from(-12.0 * kMm);
  double low = -2.0 * kMm, high = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double x = 0.5 * (low + high), r = 8.0 * kMm - x;
    const auto path = layered_path<double>(stack, 2.0 * kMm, r * r);
    const double tangent = r * path.sine_over_lateral / 1.41 / path.cosine_last;
    (x + 1.0 * kMm * tangent < 0.0 ? low : high) = x;
  }
  const double column = 400 * (low / (4.0 * kMm) + 0.5);
  EXPECT_LT(column, 180.0);  // a straight ray would put it at −1.0 mm … here it is refracted towards the wall
  int last_lit = 0;
  while (result.basis.at(last_lit, 1, 0) > 0.0f) ++last_lit;
  EXPECT_NEAR(last_lit, column, 1.0);
}

TEST(Coating, LobeKeepsItsEnergyAndStaysFinite) {
  // ∫ f cos θ dω over the half space, from everywhere to one direction (a white furnace): at most 1, for any roughness.
  constexpr int kPolar = 1500, kAzimuth = 240;
  for (const double alpha : {0.1, 0.3, 0.8}) {
    const Coating mirror{.albedo = {0, 0, 0}, .specular_f0 = 1.0, .ggx_alpha = alpha};
    for (const double view_deg : {0.0, 40.0, 75.0, 89.9, 90.0}) {
      const double v = view_deg * std::numbers::pi / 180.0;
      double glossy = 0.0, diffuse = 0.0;
      for (int i = 0; i < kPolar; ++i) {
        const double theta = (i + 0.5) / kPolar * 0.5 * std::numbers::pi;
        for (int j = 0; j < kAzimuth; j += kLanes) {
          SurfacePack surface{};
          Pack3 light{};
          surface.normal.z = Pack{} - 1.0;
          surface.view = {Pack{} + std::sin(v), Pack{}, Pack{} - std::cos(v)};
          for (int l = 0; l < kLanes; ++l) {
            const double azimuth = 2.0 * std::numbers::pi * (j + l + 0.5) / kAzimuth;
            light.x[l] = std::sin(theta) * std::cos(azimuth);
            light.y[l] = std::sin(theta) * std::sin(azimuth);
            light.z[l] = -std::cos(theta);
          }
          const CoatingResponse response = coating_response(surface, light, mirror);
          const double solid =
              std::sin(theta) * (0.5 * std::numbers::pi / kPolar) * (2.0 * std::numbers::pi / kAzimuth);
          for (int l = 0; l < kLanes; ++l) {
            ASSERT_TRUE(std::isfinite(response.gloss[l]) && response.gloss[l] >= 0.0);
            glossy += response.gloss[l] * solid;
            diffuse += response.diffuse[l] * solid;
          }
        }
      }
      EXPECT_NEAR(diffuse, 1.0, 1e-3);
      EXPECT_LE(glossy, 1.001) << alpha << ", " << view_deg;
      if (alpha < 0.2 && view_deg < 50.0) {
        EXPECT_GT(glossy, 0.95) << "a smooth mirror returns nearly all";
      }
    }
  }
}

TEST(Trace, LobeShinesWhereTheMirrorDirectionIs) {
  Sensor sensor = plain_sensor(41, 31);
  sensor.coating = {.albedo = {0.5, 0.5, 0.5}, .specular_f0 = 0.04, .ggx_alpha = 0.1};
  sensor.leds = {point_light({2e-3, 0.0, -12e-3})};  // as high as the camera: mirrored half way, at x = 1 mm
  const TraceResult result = trace(height_field(4e-3, 4e-3, 5e-4, flat), sensor, {.subpixels = 1});
  int brightest = 0;
  for (int column = 0; column < 41; ++column) {
    if (result.gloss.at(column, 15, 0) > result.gloss.at(brightest, 15, 0)) brightest = column;
  }
  EXPECT_NEAR((brightest + 0.5) / 41 * 4.0 - 2.0, 1.0, 0.1);
  // At the mirror direction: E n·l D F G / (4 n·l n·v), with D = 1/(π α²), F = f0, G ≈ 1.
  const double cosine = 12.0 / std::hypot(12.0, 1.0), distance = std::hypot(12e-3, 1e-3);
  const double expected = 1.0 / (distance * distance) / (std::numbers::pi * 0.01) * 0.04 / (4.0 * cosine);
  EXPECT_NEAR(result.gloss.at(brightest, 15, 0) / expected, 1.0, 0.02);
}

TEST(LightGroups, ShareAChannelWithTheirIntensities) {
  Sensor sensor = layered_sensor(16, 12);
  sensor.leds = {point_light({8e-3, 0.0, -12e-3}), point_light({0.0, 8e-3, -12e-3}), point_light({-8e-3, 0.0, -12e-3})};
  sensor.leds[0].group = sensor.leds[2].group = "sides";
  sensor.leds[2].intensity = 0.25;
  const Membrane ball = height_field(4e-3, 4e-3, 1e-4, ball_press);
  const FloatImage grouped = trace(ball, sensor, {}).basis;
  ASSERT_EQ(grouped.channels, 2);
  sensor.leds[0].group = sensor.leds[2].group = "";
  const FloatImage each = trace(ball, sensor, {}).basis;
  ASSERT_EQ(each.channels, 3);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 16; ++x) {
      EXPECT_NEAR(grouped.at(x, y, 0), each.at(x, y, 0) + each.at(x, y, 2), 1e-6f * grouped.at(x, y, 0));
      EXPECT_EQ(grouped.at(x, y, 1), each.at(x, y, 1));
    }
  }
}

TEST(LightGroups, ImagesTimesTheirColoursAreTheWholeImage) {
  Sensor sensor = layered_sensor(16, 12);
  sensor.leds = {point_light({8e-3, 0.0, -12e-3}), point_light({0.0, 8e-3, -12e-3}), point_light({-8e-3, 0.0, -12e-3})};
  sensor.leds[0].group = sensor.leds[2].group = "sides";
  sensor.leds[0].rgb = sensor.leds[2].rgb = {0.9, 0.3, 0.0};
  sensor.leds[1].rgb = {0.1, 0.2, 0.7};
  sensor.leds[2].intensity = 0.25;
  sensor.coating = {.albedo = {0.6, 0.5, 0.4}, .specular_f0 = 0.04, .ggx_alpha = 0.4};
  sensor.ambient_rgb = {10.0, 20.0, 30.0};
  const TraceResult result = trace(height_field(4e-3, 4e-3, 1e-4, ball_press), sensor, {.indirect_rays = 16});
  const FloatImage whole = color_image(result, sensor, false);
  const FloatImage sides = group_image(result, sensor, 0), other = group_image(result, sensor, 1);
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    const std::size_t c = i % 3;
    const double sum = sensor.leds[0].rgb[c] * sides.pixels[i] + sensor.leds[1].rgb[c] * other.pixels[i];
    EXPECT_NEAR(whole.pixels[i], sum + sensor.ambient_rgb[c], 1e-5 * whole.pixels[i]) << i;
  }
  EXPECT_GT(sides.at(3, 5, 0), sides.at(3, 5, 2));  // the paint is in them
}

TEST(Markers, DarkenTheirDiscsAndMoveWithTheMaterial) {
  Sensor sensor = layered_sensor(80, 60);
  sensor.leds = {point_light({5e-3, 3e-3, -12e-3})};
  sensor.coating = {.albedo = {0.6, 0.6, 0.6}, .specular_f0 = 0.04, .ggx_alpha = 0.4};
  sensor.markers = {.rows = 3, .columns = 3, .pitch_m = 1e-3, .radius_m = 0.2e-3, .albedo = {0.06, 0.06, 0.06}};
  Membrane membrane = height_field(4e-3, 4e-3, 1e-4, flat);
  membrane.positions.col(0).array() += 0.3e-3;  // all dragged 0.3 mm to the right
  const TraceResult result = trace(membrane, sensor, {.subpixels = 4});
  const FloatImage with = color_image(result, sensor, true), without = color_image(result, sensor, false);
  double darkened = 0.0, x_sum = 0.0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      const double share = 1.0 - with.at(x, y, 0) / without.at(x, y, 0);
      darkened += share;
      x_sum += share * x;
      EXPECT_EQ(result.segment.at(x, y, 0) == static_cast<std::uint8_t>(Segment::marker), share > 0.45)
          << x << " " << y;
    }
  }
  // Nine discs of 0.2 mm in a 4 × 3 mm window of 80 × 60 px, each darkened to a tenth of the paint and without lobe.
  const double gloss_share = [&] {
    double gloss = 0.0, all = 0.0;
    for (std::size_t i = 0; i < result.gloss.pixels.size(); ++i) {
      gloss += result.gloss.pixels[i];
      all += 0.6 * result.basis.pixels[i] + result.gloss.pixels[i];
    }
    return gloss / all;
  }();
  const double area = 9.0 * std::numbers::pi * 0.2 * 0.2 * (80 * 60) / 12.0;
  EXPECT_NEAR(darkened / area, 0.9 * (1.0 - gloss_share) + gloss_share, 0.02);
  EXPECT_NEAR((x_sum / darkened + 0.5) / 80 * 4.0 - 2.0, 0.3, 0.01);
}

TEST(Markers, AreDarkInTheVeilToo) {
  Sensor sensor = layered_sensor(20, 15);
  sensor.leds = {point_light({5e-3, 3e-3, -12e-3})};
  sensor.leds[0].rgb = {0.0, 0.0, 0.0};
  sensor.coating.albedo = {0.5, 0.5, 0.5};
  sensor.ambient_rgb = {10.0, 20.0, 30.0};
  sensor.markers = {.rows = 1, .columns = 1, .pitch_m = 1e-3, .radius_m = 0.5e-3, .albedo = {0.05, 0.05, 0.05}};
  const TraceResult result = trace(height_field(4e-3, 4e-3, 1e-4, flat), sensor, {});
  const FloatImage image = color_image(result, sensor, true);
  EXPECT_FLOAT_EQ(image.at(10, 7, 2), 3.0f);
  EXPECT_FLOAT_EQ(image.at(1, 1, 2), 30.0f);
  double covered = 0.0;
  for (const float share : result.coverage.pixels) covered += share;
  EXPECT_NEAR(covered * 12.0 / (20 * 15), 0.25 * std::numbers::pi, 0.05);  // mm²
}

TEST(Fields, MapsShowTractionAndStatesWhereTheyAre) {
  Sensor sensor = layered_sensor(40, 30);
  sensor.leds = {point_light({5e-3, 3e-3, -12e-3})};
  const Membrane membrane = height_field(4e-3, 4e-3, 1e-4, flat);
  SurfaceFields fields;
  fields.traction_pa.resize(membrane.positions.rows(), 3);
  for (Eigen::Index v = 0; v < membrane.positions.rows(); ++v) {
    const double x = membrane.positions(v, 0), y = membrane.positions(v, 1);
    fields.traction_pa.row(v) << 1e6 * x, 2e6 * y, -500.0;
    fields.contact.push_back(x < -0.5e-3 ? ContactState::none : x < 0.5e-3 ? ContactState::stick : ContactState::slip);
  }
  const TraceResult result = trace(membrane, sensor, {}, fields);
  const CameraModel camera(sensor.camera, sensor.stack);
  for (int row = 1; row < 30; row += 7) {
    for (int column = 0; column < 40; ++column) {
      const auto point = camera.on_plane(column + 0.5, row + 0.5);
      EXPECT_NEAR(result.traction.at(column, row, 0), 1e6 * point->x(), 1e-2);
      EXPECT_NEAR(result.traction.at(column, row, 1), 2e6 * point->y(), 1e-2);
      EXPECT_NEAR(result.traction.at(column, row, 2), -500.0, 1e-3);
      if (std::abs(std::abs(point->x()) - 0.5e-3) < 0.1e-3) continue;  // the boundary lies between vertices
      EXPECT_EQ(result.contact.at(column, row, 0), point->x() < -0.5e-3 ? 0 : point->x() < 0.5e-3 ? 1 : 2);
      EXPECT_EQ(result.segment.at(column, row, 0), point->x() < -0.5e-3 ? 1 : 2);
    }
  }
}

TEST(Diffuser, PassesItsShareAndShadesTheDirectLight) {
  Sensor sensor = layered_sensor(8, 6);
  sensor.leds = {point_light({10e-3, 0.0, -13e-3})};
  sensor.leds[0].emission = Emission::lambertian;
  const double bare = light_samples(sensor, 1).front().weight;
  EXPECT_EQ(bare, 1.0);
  sensor.diffuser = Diffuser{.inner_radius_m = 8e-3, .outer_radius_m = 14e-3, .z_m = -10e-3, .transmittance = 0.5};
  double scattered = 0.0;
  const auto samples = light_samples(sensor, 1);
  ASSERT_GT(samples.size(), 8u);
  for (std::size_t i = 1; i < samples.size(); ++i) scattered += samples[i].weight;
  // Flux: half of what a Lambert light (π I0 in all) sends through the ring comes out again as π Σ weight. Most of it
  // meets the ring: 3 mm away, 2 mm from its inner and 4 mm from its outer edge.
  EXPECT_LT(scattered, 0.5);
  EXPECT_GT(scattered, 0.25);
  // Straight below the ring's hole the LED is seen through the hole or not at all.
  const Pack zero{};
  const auto direct = [&](double x) { return light_path({zero + x, zero, zero}, samples.front()).irradiance[0]; };
  EXPECT_EQ(direct(9e-3), 0.0);
  EXPECT_GT(direct(-9e-3), 0.0);
}

TEST(Trace, LayeredBytesDoNotDependOnThreads) {
  Sensor sensor = layered_sensor(64, 48);
  sensor.coating.specular_f0 = 0.04;
  sensor.coating.ggx_alpha = 0.4;
  sensor.markers = {.rows = 3, .columns = 3, .pitch_m = 1e-3, .radius_m = 0.2e-3};
  sensor.leds = {point_light({8e-3, 0.0, -12e-3}), {.position_m = {0.0, 8e-3, -13e-3}, .size_m = {5e-3, 5e-3}}};
  const Membrane ball = height_field(4e-3, 3e-3, 1e-4, ball_press);
  std::vector<TraceResult> results;
  for (const std::size_t threads : {1u, 2u, 5u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(trace(ball, sensor, {}));
    EXPECT_EQ(results.back().basis.pixels, results[0].basis.pixels);
    EXPECT_EQ(results.back().gloss.pixels, results[0].gloss.pixels);
    EXPECT_EQ(results.back().marked.pixels, results[0].marked.pixels);
    EXPECT_EQ(results.back().segment.pixels, results[0].segment.pixels);
    EXPECT_EQ(results.back().outside_rays, 0);
  }
}

}  // namespace trace_layered_test
}  // namespace tacipc
