#include "common/sensor/light_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "common/sensor/membrane_view.h"
#include "tests/common/sensor/pinhole.h"
#include "tests/config_text.h"

namespace tacipc {
namespace light_field_test {

Sensor sensor(int width = 60, int height = 40) {
  Sensor out;
  out.camera = {.position_m = {0, 0, -50e-3},
                .width_px = width,
                .height_px = height,
                .window_width_m = 0.1e-3 * width,
                .window_height_m = 0.1e-3 * height};
  return out;
}

/// Indentation by a formula of the undeformed front's point behind a pixel (m).
MembraneView view_of(const std::function<double(double, double)>& indentation, const Sensor& at) {
  FloatImage map(at.camera.width_px, at.camera.height_px, 1);
  const Pinhole pinhole(at.camera);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vector3 p = pinhole.plane_point(x, y);
      map.at(x, y, 0) = static_cast<float>(indentation(p.x(), p.y()));
    }
  return view_height_map(map, at);
}

TEST(MembraneView, HeightMapsHaveTheirPointsOnThePixelsRays) {
  const MembraneView view = view_of([](double, double) { return 1e-3; }, sensor());
  const Pinhole pinhole(sensor().camera);
  const std::size_t i = view.index(55, 3);
  EXPECT_NEAR((view.point[i] - (pinhole.position + 49e-3 * pinhole.ray(55, 3))).norm(), 0.0, 1e-9);
  EXPECT_NEAR(view.point[i].x(), view.rest[i].x() * 49.0 / 50.0, 1e-9);  // nearer to the camera: parallax
  EXPECT_NEAR((view.normal[i] - Vector3::UnitZ()).norm(), 0.0, 1e-9);
}

TEST(MembraneView, MovingTurnsAboutZThenTranslates) {
  Positions p(1, 3);
  p << 1.0, 0.0, -0.5;
  const Positions out = moved(p, 10.0, 20.0, std::numbers::pi / 2);
  EXPECT_NEAR((out.row(0) - Eigen::RowVector3d(10.0, 21.0, -0.5)).norm(), 0.0, 1e-15);
}

TEST(RelativeIrradiance, FlatIsZeroAndASlopeIsTheCosinesRatio) {
  const Vector3 lamp(30e-3, 10e-3, -12e-3);
  const MembraneView flat = view_of([](double, double) { return 0.0; }, sensor());
  EXPECT_NEAR(relative_irradiance(flat, 12, 30, lamp, 0.1), 0.0, 1e-12);
  // A slope through the origin: there point and distance are the flat ones, only the cosine changes.
  const MembraneView slope = view_of([](double x, double) { return 0.2 * x; }, sensor(61, 41));
  const std::size_t i = slope.index(30, 20);
  EXPECT_NEAR(slope.point[i].norm(), 0.0, 1e-12);
  const Vector3 n = slope.normal[i];
  EXPECT_NEAR(n.x() / n.z(), 0.2, 1e-5);
  EXPECT_NEAR(relative_irradiance(slope, 30, 20, lamp, 0.01), -n.dot(lamp) / -lamp.z() - 1.0, 1e-9);
  // Turned away from the lamp: dark.
  const MembraneView away = view_of([](double x, double) { return 0.9 * x; }, sensor(61, 41));
  EXPECT_EQ(relative_irradiance(away, 30, 20, lamp, 0.01), -1.0);
}

TEST(Visibility, AWallShadesAsFarAsItsHeightOverTheLampsElevation) {
  // The front is flat at x < 1 mm and 0.5 mm into the gel beyond; the lamp is far away towards +x at elevation 1/2: the
  // wall's shadow ends 0.5 mm / (1/2) = 1 mm before it.
  const MembraneView view = view_of([](double x, double) { return x > 1e-3 ? 0.5e-3 : 0.0; }, sensor());
  const Vector3 lamp(10.0, 0.0, -5.0);
  const auto visibility_at = [&](double x_mm) {
    return lamp_visibility(view, static_cast<int>(std::lround(10.0 * x_mm + 29.5)), 20, lamp, 0.05);
  };
  // To within a step of the march, 1.5 pixels or 0.15 mm.
  EXPECT_EQ(visibility_at(0.85), 0.0);
  EXPECT_EQ(visibility_at(0.25), 0.0);
  EXPECT_EQ(visibility_at(-0.25), 1.0);
  // The lamp on the other side sees all of it but the top of the wall's far side.
  EXPECT_EQ(lamp_visibility(view, 5, 20, Vector3(-10.0, 0.0, -5.0), 0.05), 1.0);
}

LightField example() {
  LightField light{.geometry = {.lamps_m = {{20e-3, 0, -9e-3}, {-5e-3, 25e-3, -8e-3}},
                                .shadow_softness = 0.125,
                                .environment_degree = 2,
                                .field_half_width_m = 3e-3},
                   .weights = {},
                   .blur_px = 0.75};
  light.weights.resize(light.geometry.num_features(), 3);
  for (Eigen::Index i = 0; i < light.weights.size(); ++i)
    light.weights.data()[i] = std::sin(1.0 + static_cast<double>(i));
  return light;
}

TEST(Features, OfAFieldOfSecondDegreeHaveItsTermsAndComeBackFromTheirFile) {
  LightField light = example();
  light.geometry.field_degree = 2;
  EXPECT_EQ(light.geometry.num_features(), 6 * (2 * 2 + 5));
  EXPECT_EQ(light.geometry.first_environment_feature(), 24);
  light.weights.resize(light.geometry.num_features(), 3);
  for (Eigen::Index i = 0; i < light.weights.size(); ++i) light.weights.data()[i] = std::cos(static_cast<double>(i));
  const MembraneView view = view_of([](double x, double y) { return 0.1 * x + 0.05 * y + 1e-3; }, sensor());
  Eigen::VectorXd f(light.geometry.num_features());
  LightFeatures(light.geometry, view).at(45, 10, f.data());
  const std::size_t i = view.index(45, 10);
  const double x = view.rest[i].x() / 3e-3, y = view.rest[i].y() / 3e-3, n = view.normal[i].x();
  const double terms[] = {1.0, x, y, x * x, x * y, y * y};
  for (Eigen::Index k = 0; k < 6; ++k) EXPECT_NEAR(f[24 + k], n * terms[k], 1e-15) << k;
  const LightField read = config_from_text<LightField>(to_yaml(light.to_value()), "light.yaml");
  EXPECT_EQ(read.geometry.field_degree, 2);
  EXPECT_EQ(read.weights, light.weights);
}

TEST(Features, StandInTheirOrder) {
  const LightField light = example();
  EXPECT_EQ(light.geometry.num_features(), 3 * (2 * 2 + 5));
  EXPECT_EQ(light.geometry.first_environment_feature(), 12);
  const MembraneView view = view_of([](double x, double y) { return 0.1 * x + 0.05 * y + 1e-3; }, sensor());
  Eigen::VectorXd f(light.geometry.num_features());
  LightFeatures(light.geometry, view).at(45, 10, f.data());
  const std::size_t i = view.index(45, 10);
  const double x = view.rest[i].x() / 3e-3, y = view.rest[i].y() / 3e-3;
  const double q = relative_irradiance(view, 45, 10, light.geometry.lamps_m[1], 0.125);
  const Vector3 n = view.normal[i];
  EXPECT_THAT(std::vector<double>(f.data() + 6, f.data() + 12),
              testing::ElementsAre(q, q * x, q * y, q * q, q * q * x, q * q * y));
  const std::vector<double> monomials{n.x(), n.y(), n.x() * n.x(), n.x() * n.y(), n.y() * n.y()};
  for (std::size_t m = 0; m < 5; ++m) {
    EXPECT_NEAR(f[static_cast<Eigen::Index>(12 + 3 * m)], monomials[m], 1e-15);
    EXPECT_NEAR(f[static_cast<Eigen::Index>(12 + 3 * m + 2)], monomials[m] * y, 1e-15);
  }
}

TEST(CodeChange, IsTheWeightsTimesTheFeaturesOfEveryPixel) {
  LightField light = example();
  light.blur_px = 0.0;
  light.geometry.field_degree = 2;
  light.geometry.environment_depth = true;
  light.geometry.dome = {.azimuths = 4, .elevation_tan = {0.0, 0.2, 0.6}};
  light.weights.resize(light.geometry.num_features(), 3);
  for (Eigen::Index i = 0; i < light.weights.size(); ++i) light.weights.data()[i] = std::cos(static_cast<double>(i));
  // A bump that hides light from what lies beside it.
  const MembraneView view =
      view_of([](double x, double y) { return 0.6e-3 * std::exp(-(x * x + 2.0 * y * y) / 0.3e-6); }, sensor());
  const FloatImage change = code_change(light, view);
  const LightFeatures of(light.geometry, view);
  Eigen::VectorXd f(light.geometry.num_features());
  double largest = 0.0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      of.at(x, y, f.data());
      const Vector3 expected = light.weights.transpose() * f;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(change.at(x, y, c), expected[c], 1e-5) << x << ' ' << y << ' ' << c;
      largest = std::max(largest, expected.cwiseAbs().maxCoeff());
    }
  EXPECT_GT(largest, 1.0);
}

TEST(Features, OfDepthComeLastAndComeBackFromTheirFile) {
  LightField light = example();
  light.geometry.environment_depth = true;
  ASSERT_EQ(light.geometry.num_features(), 3 * (2 * 2 + 6));
  light.weights.resize(light.geometry.num_features(), 3);
  for (Eigen::Index i = 0; i < light.weights.size(); ++i) light.weights.data()[i] = std::cos(static_cast<double>(i));
  const MembraneView view = view_of([](double x, double y) { return 0.1 * x + 0.05 * y + 1e-3; }, sensor());
  Eigen::VectorXd f(light.geometry.num_features());
  LightFeatures(light.geometry, view).at(45, 10, f.data());
  const std::size_t i = view.index(45, 10);
  const double x = view.rest[i].x() / 3e-3, y = view.rest[i].y() / 3e-3, depth_mm = -1e3 * view.point[i].z();
  EXPECT_THAT(std::vector<double>(f.data() + 27, f.data() + 30),
              testing::ElementsAre(depth_mm, depth_mm * x, depth_mm * y));
  const LightField read = config_from_text<LightField>(to_yaml(light.to_value()), "light.yaml");
  EXPECT_TRUE(read.geometry.environment_depth);
  EXPECT_EQ(read.weights, light.weights);
}

TEST(Features, OfADomeStandBetweenLampsAndPolynomialAndComeBackFromTheirFile) {
  LightField light = example();
  light.geometry.dome = {.azimuths = 4, .elevation_tan = {0.0, 0.5}};
  light.geometry.lamp_half_width_rad = {0.0, 0.3};
  ASSERT_EQ(light.geometry.num_features(), 3 * (2 * 2 + 8 + 5));
  light.weights.resize(light.geometry.num_features(), 3);
  for (Eigen::Index i = 0; i < light.weights.size(); ++i) light.weights.data()[i] = std::cos(static_cast<double>(i));
  const MembraneView view = view_of([](double x, double y) { return 0.1 * x + 0.05 * y + 1e-3; }, sensor());
  Eigen::VectorXd f(light.geometry.num_features());
  LightFeatures(light.geometry, view).at(45, 10, f.data());
  std::vector<double> dome(8);
  DomeIrradiance(light.geometry.dome, view).at(45, 10, view.normal[view.index(45, 10)], dome.data());
  for (Eigen::Index k = 0; k < 8; ++k) EXPECT_EQ(f[12 + 3 * k], dome[static_cast<std::size_t>(k)]) << k;
  EXPECT_NEAR(f[12 + 3 * 8], view.normal[view.index(45, 10)].x(), 1e-15);
  const LightField read = config_from_text<LightField>(to_yaml(light.to_value()), "light.yaml");
  EXPECT_EQ(read.weights, light.weights);
  EXPECT_EQ(read.geometry.dome.elevation_tan, light.geometry.dome.elevation_tan);
  EXPECT_NEAR(read.geometry.lamp_half_width_rad[1], 0.3, 1e-15);
  EXPECT_THAT(faults_in<LightField>("light_field: {field_half_width_mm: 1, shadow_softness: 0.1, blur_px: 0, dome: "
                                    "{azimuths: 3, bands: 2, elevation_tan: [1, 0.5]}}\n",
                                    "l.yaml"),
              testing::Contains(testing::HasSubstr("elevation_tan: expected the bands' lower edges, ascending")));
}

TEST(RelativeIrradiance, OfAWideLampIsTheMeanOverItsWidth) {
  // No distance and no shadow matters: q is the mean of the points' q, each times its share of the flat irradiance,
  // which on the axis is the same for all.
  LightGeometry geometry{.lamps_m = {{20e-3, 0, -9e-3}}, .lamp_half_width_rad = {0.6}, .shadow_softness = 0.01};
  const MembraneView slope = view_of([](double x, double y) { return 0.2 * x + 0.1 * y; }, sensor(61, 41));
  double sum = 0.0;
  constexpr int kPoints = 2001;
  for (int i = 0; i < kPoints; ++i) {
    const double turn = 0.6 * (2.0 * i / (kPoints - 1) - 1.0);
    sum += relative_irradiance(slope, 30, 20, Eigen::AngleAxisd(turn, Vector3::UnitZ()) * geometry.lamps_m[0], 0.01);
  }
  EXPECT_NEAR(relative_irradiance(geometry, slope, 30, 20, slope.normal[slope.index(30, 20)], 0), sum / kPoints, 1e-4);
}

TEST(LightFieldFile, ReadsBackToTheSameBits) {
  const LightField light = example(), again = config_from_text<LightField>(to_yaml(light.to_value()), "light.yaml");
  EXPECT_EQ(again.weights, light.weights);
  EXPECT_NEAR((again.geometry.lamps_m[1] - light.geometry.lamps_m[1]).norm(), 0.0, 1e-17);
  EXPECT_EQ(again.geometry.environment_degree, 2);
  EXPECT_EQ(again.blur_px, 0.75);
  EXPECT_THAT(
      faults_in<LightField>("light_field: {field_half_width_mm: 1, shadow_softness: 0.1, blur_px: 0}\n", "l.yaml"),
      testing::ElementsAre("l.yaml:1:14: light_field.lamps: give lamps, an environment or both"));
}

TEST(CodeChange, AFlatFrontChangesNothing) {
  const FloatImage change = code_change(example(), view_of([](double, double) { return 0.0; }, sensor()));
  for (const float code : change.pixels) EXPECT_NEAR(code, 0.0f, 1e-4f);
}

TEST(AddChange, RoundsAndClamps) {
  FloatImage change(3, 1, 1);
  change.pixels = {-300.0f, 0.5f, 10.4f};
  EXPECT_THAT(add_change(ByteImage(3, 1, 1, 250), change).pixels, testing::ElementsAre(0, 251, 255));
}

TEST(Blur, SpreadsWithItsDeviationAndKeepsTheSum) {
  FloatImage point(41, 41, 1);
  point.at(20, 20, 0) = 1.0f;
  const FloatImage out = gaussian_blurred(point, 2.0);
  double sum = 0.0, square = 0.0;
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 41; ++x) {
      sum += out.at(x, y, 0);
      square += double{out.at(x, y, 0)} * ((x - 20) * (x - 20));
    }
  EXPECT_NEAR(sum, 1.0, 1e-6);
  EXPECT_NEAR(square, 4.0, 0.02);
  const FloatImage grey = gaussian_blurred(FloatImage(5, 3, 3, 7.0f), 1.2);
  for (const float v : grey.pixels) EXPECT_NEAR(v, 7.0f, 1e-5f);
}

}  // namespace light_field_test
}  // namespace tacipc
