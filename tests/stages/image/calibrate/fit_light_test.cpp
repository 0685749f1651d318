#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "stages/image/calibrate/fit_light.h"
#include "tests/common/sensor/pinhole.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace fit_light_test {

TEST(GaussNewton, LinearProblemsAreSolvedWithTheirCovariance) {
  // Line through four points: closed form (JᵀJ)⁻¹ σ².
  const Eigen::Vector4d x(0, 1, 2, 3), y(1.1, 2.9, 5.2, 6.8);
  const auto residuals = [&](const Eigen::VectorXd& u) { return Eigen::VectorXd(u[0] + u[1] * x.array() - y.array()); };
  const GaussNewtonSettings settings{.step = Eigen::Vector2d(1e-3, 1e-3),
                                     .lower = Eigen::Vector2d(-100, -100),
                                     .upper = Eigen::Vector2d(100, 100),
                                     .max_iterations = 50,
                                     .relative_decrease = 1e-14};
  const auto result = gauss_newton(residuals, Eigen::Vector2d(50, -50), settings);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.parameters[1], 1.94, 1e-6);
  EXPECT_NEAR(result.parameters[0], 1.09, 1e-6);
  const double variance = result.sum_of_squares / 2.0;
  EXPECT_NEAR(result.covariance(1, 1), variance / 5.0, 1e-6 * variance);   // Σ(x − x̄)² = 5
  EXPECT_NEAR(result.covariance(0, 0), variance * 0.7, 1e-6 * variance);   // 1/4 + 1.5² / 5
  EXPECT_NEAR(result.covariance(0, 1), -variance * 0.3, 1e-6 * variance);  // −x̄ / 5
  const double c = 6.0 / std::sqrt(4.0 * 14.0);                            // cosine of the two columns
  EXPECT_NEAR(result.condition, std::sqrt((1 + c) / (1 - c)), 1e-4);
}

TEST(GaussNewton, CurvedValleysAndBounds) {
  const auto rosenbrock = [](const Eigen::VectorXd& u) {
    return Eigen::VectorXd(Eigen::Vector3d(10.0 * (u[1] - u[0] * u[0]), 1.0 - u[0], 0.0));
  };
  GaussNewtonSettings settings{.step = Eigen::Vector2d(1e-6, 1e-6),
                               .lower = Eigen::Vector2d(-10, -10),
                               .upper = Eigen::Vector2d(10, 10),
                               .max_iterations = 200,
                               .relative_decrease = 0.0};
  EXPECT_NEAR(
      (gauss_newton(rosenbrock, Eigen::Vector2d(-1.2, 1.0), settings).parameters - Eigen::Vector2d(1, 1)).norm(), 0.0,
      1e-4);
  settings.upper[0] = 0.5;
  const auto bounded = gauss_newton(rosenbrock, Eigen::Vector2d(-1.2, 1.0), settings);
  EXPECT_LE(bounded.parameters[0], 0.5);
  EXPECT_NEAR(bounded.parameters[0], 0.5, 1e-3);
}

TEST(Labels, AreReadAndFaultsNameTheirLine) {
  const ScratchFolder scratch;
  const auto labels = read_labels(scratch.file("l.txt", "a_real.png (212, 128) 26\n\nb.png (1.5,2) 3.25\r\n"));
  ASSERT_EQ(labels.size(), 2u);
  EXPECT_EQ(labels[0].image, "a_real.png");
  EXPECT_EQ(labels[0].y_px, 128.0);
  EXPECT_EQ(labels[1].radius_px, 3.25);
  const auto bad = scratch.file("bad.txt", "a.png (1, 2) 3\na.png 1, 2, 3\n");
  EXPECT_EQ(message_of<DataError>([&] { read_labels(bad); }), bad.string() + ":2: expected `image.png (x, y) radius`");
  const auto empty = scratch.file("empty.txt", "\n");
  EXPECT_EQ(message_of<DataError>([&] { read_labels(empty); }), empty.string() + ": holds no labels");
}

constexpr double kRadius = 3e-3;

/// A ball's cap down to a contact radius a, beyond it a smooth fall-off of equal slope: no gel's answer, but a membrane
/// whose rim and depth are known.
double cap(double r, double depth) {
  const double a = std::sqrt(kRadius * depth);
  const auto sphere = [&](double at) { return kRadius - std::sqrt(kRadius * kRadius - at * at); };
  if (r < a) return depth - sphere(r);
  const double edge = depth - sphere(a), slope = a / std::sqrt(kRadius * kRadius - a * a);
  return edge * std::exp(-slope / edge * (r - a));
}

TEST(ContactRadius, IsWhereTheGapOpens) {
  const double depth = 0.6e-3;
  Positions front(160 * 160, 3);
  for (int i = 0; i < 160 * 160; ++i) {
    const int row = i / 160;
    const double x = 5e-5 * (i % 160 - 79.5), y = 5e-5 * (row - 79.5);
    front.row(i) << x, y, -cap(std::hypot(x, y), depth);
  }
  // Gap g beyond the rim by definition; solve for where it is 10 µm.
  double r = std::sqrt(kRadius * depth);
  const auto gap = [&](double at) {
    return -depth + kRadius - std::sqrt(kRadius * kRadius - at * at) + cap(at, depth);
  };
  while (gap(r) < 10e-6) r += 1e-6;
  EXPECT_NEAR(contact_radius(front, depth, kRadius, 10e-6), r, 20e-6);
  front.col(2).setZero();
  EXPECT_EQ(contact_radius(front, 0.0, kRadius, 1e-9), 0.0);
}

TEST(GapAtRadius, IsTheInverseOfTheContactRadius) {
  Positions front(160 * 160, 3);
  for (int i = 0; i < 160 * 160; ++i) {
    const int row = i / 160;
    const double x = 5e-5 * (i % 160 - 79.5), y = 5e-5 * (row - 79.5);
    front.row(i) << x, y, -cap(std::hypot(x, y), 0.6e-3);
  }
  for (const double gap : {10e-6, 50e-6, 200e-6})
    EXPECT_NEAR(gap_at_radius(front, 0.6e-3, kRadius, contact_radius(front, 0.6e-3, kRadius, gap)), gap, 1e-9);
  EXPECT_NEAR(gap_at_radius(front, 0.6e-3, kRadius, 0.0), 0.0, 1e-9);
}

TEST(BallPose, TurnsTheBallOverAndPutsItsLowestPointAtTheDepth) {
  const Matrix4 pose = ball_pose(1e-3, -2e-3, 0.4e-3, kRadius);
  const Eigen::Vector4d lowest = pose * Eigen::Vector4d(0, 0, kRadius, 1), at(1e-3, -2e-3, -0.4e-3, 1);
  EXPECT_NEAR((lowest - at).norm(), 0.0, 1e-15);
  const Matrix3 turn = pose.topLeftCorner<3, 3>();
  EXPECT_NEAR(turn.determinant(), 1.0, 1e-15);
}

Sensor sensor() {
  Sensor out;
  out.camera = {.position_m = {0, 0, -49e-3},
                .width_px = 120,
                .height_px = 120,
                .window_width_m = 12e-3,
                .window_height_m = 12e-3};
  return out;
}

MembraneView ball_view(double x_m, double y_m, double depth) {
  FloatImage map(120, 120, 1);
  const Pinhole pinhole(sensor().camera);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const Vector3 p = pinhole.plane_point(x, y);
      map.at(x, y, 0) = static_cast<float>(cap(std::hypot(p.x() - x_m, p.y() - y_m), depth));
    }
  return view_height_map(map, sensor());
}

CalibrateConfig config() {
  CalibrateConfig out{.ball_radius_m = kRadius,
                      .contact_gap_m = 2e-5,
                      .label_sigma_px = 0.0,
                      .fit_radius_px = 30,
                      .fit_stride_px = 2,
                      .drift_radius_px = 45,
                      .lamps = {},
                      .bounds = {.azimuth_rad = 0.5, .elevation_tan = {0.2, 0.9}, .distance_m = {10e-3, 60e-3}},
                      .fit_lamps = true,
                      .geometry = {.shadow_softness = 0.2, .environment_degree = 2},
                      .blur_px = 0.0,
                      .ridge = 1e-9,
                      .folds = 4};
  for (const double degrees : {10.0, 130.0, 250.0})
    out.lamps.push_back({.azimuth_rad = degrees * std::numbers::pi / 180, .distance_m = 25e-3, .elevation_tan = 0.5});
  return out;
}

/// Photographs under a known light: lamps at other places than the guess, colours mixed, a drift and clipping.
std::vector<Ball> synthetic_balls(const LightField& light, const CalibrateConfig& settings) {
  const ByteImage background(120, 120, 3, 128);
  std::vector<Ball> balls;
  for (int i = 0; i < 8; ++i) {
    Ball ball;
    ball.label = {
        .image = "ball_" + std::to_string(i), .x_px = 40.0 + 5 * (i % 4), .y_px = 40.0 + 8 * (i % 5), .radius_px = 12};
    ball.x_m = (ball.label.x_px + 0.5 - 60) * 1e-4;
    ball.y_m = (ball.label.y_px + 0.5 - 60) * 1e-4;
    ball.depth_m = 0.3e-3 + 0.05e-3 * i;
    ball.view = ball_view(ball.x_m, ball.y_m, ball.depth_m);
    FloatImage change = code_change(light, ball.view);
    for (std::size_t k = 0; k < change.pixels.size(); ++k) change.pixels[k] += static_cast<float>(k % 3) + 1.0f;
    ball.samples = make_samples(add_change(background, change), background, ball.label, settings);
    balls.push_back(std::move(ball));
  }
  return balls;
}

LightField true_light() {
  LightField light{.geometry = {.shadow_softness = 0.2, .field_half_width_m = 6e-3}, .weights = {}, .blur_px = 0.0};
  for (const auto& [degrees, elevation] : {std::pair{22.0, 0.42}, {118.0, 0.55}, {255.0, 0.47}})
    light.geometry.lamps_m.push_back(
        LampGuess{.azimuth_rad = degrees * std::numbers::pi / 180, .distance_m = 20e-3, .elevation_tan = elevation}
            .position_m());
  light.weights = Codes::Zero(light.geometry.num_features(), 3);
  for (Eigen::Index l = 0; l < 3; ++l)
    for (Eigen::Index c = 0; c < 3; ++c) {
      light.weights(6 * l, c) = l == c ? 60.0 : -12.0;   // a colour matrix
      light.weights(6 * l + 1, c) = l == c ? 9.0 : 2.0;  // vignetting along x
    }
  return light;
}

TEST(FitLight, FindsLampsFromPhotographsOfBalls) {
  const CalibrateConfig settings = config();
  std::vector<Ball> balls = synthetic_balls(true_light(), settings);
  EXPECT_NEAR(balls[0].samples.drift[2], 3.0, 0.2);
  std::vector<KnownObject> objects;
  const LightFit fit = fit_light(balls, objects, nullptr, sensor(), settings);
  ASSERT_TRUE(fit.lamps.has_value());
  const Eigen::VectorXd& u = fit.lamps->parameters;
  const double degrees[] = {22.0, 118.0, 255.0}, elevation[] = {0.42, 0.55, 0.47};
  for (Eigen::Index l = 0; l < 3; ++l) {
    EXPECT_NEAR(u[3 * l] * 180 / std::numbers::pi, degrees[l], 2.0) << "lamp " << l;
    EXPECT_NEAR(u[3 * l + 1], elevation[l], 0.03) << "lamp " << l;
  }
  // Rounding alone leaves 0.29 codes.
  for (const double rmse : fit.rmse_codes) EXPECT_LT(rmse, 0.5);
  // Left-out balls are told by the lamps, not by the polynomial.
  ASSERT_EQ(fit.held_out.size(), 3u);
  EXPECT_LT(fit.held_out[0].rmse_codes, 0.6);
  EXPECT_GT(fit.held_out[1].rmse_codes, 2.0 * fit.held_out[0].rmse_codes);
  EXPECT_NE(fit.kind, ModelKind::environment);
  EXPECT_GT(fit.lamps->condition, 1.0);
}

/// Frames of that membrane, 0.05 mm apart.
BallPress cap_press() {
  constexpr int kSide = 121;
  BallPress press;
  press.radius_m = kRadius;
  for (int k = 0; k <= 18; ++k) {
    press.depth_m.push_back(5e-5 * k);
    Positions front(kSide * kSide, 3);
    for (int i = 0; i < kSide * kSide; ++i) {
      const int row = i / kSide;
      const double x = 5e-5 * (i % kSide - 60), y = 5e-5 * (row - 60);
      front.row(i) << x, y, k == 0 ? 0.0 : -cap(std::hypot(x, y), press.depth_m.back());
    }
    press.frames.push_back(front);
  }
  press.front.resize(2 * (kSide - 1) * (kSide - 1), 3);
  for (int j = 0, t = 0; j + 1 < kSide; ++j)
    for (int i = 0; i + 1 < kSide; ++i) {
      const int a = kSide * j + i;
      press.front.row(t++) << a, a + 1, a + kSide + 1;
      press.front.row(t++) << a, a + kSide + 1, a + kSide;
    }
  return press;
}

TEST(FitLight, FindsWhichRimTheLabelsMean) {
  CalibrateConfig settings = config();
  settings.geometry.environment_degree = 0;
  settings.fit_lamps = false;
  settings.lamps.clear();
  for (const auto& [degrees, elevation] : {std::pair{22.0, 0.42}, {118.0, 0.55}, {255.0, 0.47}})
    settings.lamps.push_back(
        {.azimuth_rad = degrees * std::numbers::pi / 180, .distance_m = 20e-3, .elevation_tan = elevation});
  settings.label_sigma_px = 2.0;
  settings.fit_contact_gap = true;
  BallPress press = cap_press();
  constexpr double kSeen = 60e-6;  // labels are drawn here, and the fit starts at 20 µm
  std::vector<Ball> balls;
  std::vector<double> depths;
  for (int i = 0; i < 6; ++i) {
    Ball ball;
    ball.label = {.image = "b", .x_px = 45.0 + 6 * (i % 3), .y_px = 48.0 + 5 * i, .radius_px = 0.0};
    ball.x_m = (ball.label.x_px + 0.5 - 60) * 1e-4;
    ball.y_m = (ball.label.y_px + 0.5 - 60) * 1e-4;
    depths.push_back(0.33e-3 + 0.06e-3 * i);
    ball.depth_m = depths.back();
    ball.view = view_ball(press, ball, sensor());
    const ByteImage background(120, 120, 3, 128);
    ball.samples =
        make_samples(add_change(background, code_change(true_light(), ball.view)), background, ball.label, settings);
    press.set_rim(kSeen);
    ball.label.radius_px = contact_radius(press.at_depth(ball.depth_m), ball.depth_m, kRadius, kSeen) / 1e-4;
    press.set_rim(settings.contact_gap_m);
    ball.depth_m = press.depth_of_contact(ball.label.radius_px * 1e-4, "b");
    EXPECT_GT(ball.depth_m - depths.back(), 0.02e-3);  // the wrong rim makes balls too deep
    ball.view = view_ball(press, ball, sensor());
    balls.push_back(std::move(ball));
  }
  settings.folds = 3;
  std::vector<KnownObject> objects;
  const LightFit fit = fit_light(balls, objects, &press, sensor(), settings);
  EXPECT_NEAR(fit.contact_gap_m, kSeen, 6e-6);
  for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_NEAR(balls[i].depth_m, depths[i], 8e-6) << i;
}

/// A block of 4 × 4 mm, 0.8 mm deep, its walls at 60°, and the front flat beside it.
MembraneView block_view(double x_m, double y_m) {
  FloatImage map(120, 120, 1);
  const Pinhole pinhole(sensor().camera);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const Vector3 p = pinhole.plane_point(x, y);
      const double beside = std::max(std::abs(p.x() - x_m), std::abs(p.y() - y_m)) - 2e-3;
      map.at(x, y, 0) = static_cast<float>(std::clamp(0.8e-3 - std::sqrt(3.0) * beside, 0.0, 0.8e-3));
    }
  return view_height_map(map, sensor());
}

/// Its codes with noise of 1.2 codes that is the same at every run.
ByteImage noisy_photograph(const LightField& light, const MembraneView& view, unsigned seed) {
  FloatImage change = code_change(light, view);
  for (float& code : change.pixels) {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) / 16777216.0;
    code += static_cast<float>(1.2 * std::sqrt(3.0) * (sum - 2.0));
  }
  return add_change(ByteImage(120, 120, 3, 128), change);
}

TEST(FitLight, AKnownObjectTellsLampsThatShallowBallsDoNot) {
  CalibrateConfig settings = config();
  settings.bounds = {
      .azimuth_rad = 0.5, .elevation_tan = {0.2, 0.9}, .distance_m = {10e-3, 60e-3}, .half_width_rad = {0.05, 0.7}};
  settings.lamps.resize(2);
  for (LampGuess& lamp : settings.lamps) lamp.half_width_rad = 0.3;
  settings.geometry.shadow_softness = 0.1;
  settings.ridge = 1e-8;
  const double azimuth[] = {0.3, 2.1}, elevation[] = {0.45, 0.6}, width[] = {0.45, 0.2};
  LightField light{.geometry = {.shadow_softness = 0.1, .field_half_width_m = 6e-3}, .weights = {}, .blur_px = 0.0};
  std::vector<LampGuess> lamps;
  for (std::size_t l = 0; l < 2; ++l)
    lamps.push_back(
        {.azimuth_rad = azimuth[l], .distance_m = 20e-3, .elevation_tan = elevation[l], .half_width_rad = width[l]});
  set_lamps(light.geometry, lamps);
  light.weights = Codes::Zero(light.geometry.num_features(), 3);
  light.weights.row(0) << 60.0, -12.0, -10.0;
  light.weights.row(6) << -10.0, 55.0, 30.0;
  const ByteImage background(120, 120, 3, 128);
  std::vector<Ball> balls;
  for (int i = 0; i < 6; ++i) {
    Ball ball;
    ball.label = {.image = "b", .x_px = 42.0 + 6 * (i % 3), .y_px = 45.0 + 5 * i, .radius_px = 10};
    ball.view = ball_view((ball.label.x_px - 59.5) * 1e-4, (ball.label.y_px - 59.5) * 1e-4, 0.1e-3 + 0.02e-3 * i);
    const auto seed = static_cast<unsigned>(7 + i);
    ball.samples = make_samples(noisy_photograph(light, ball.view, seed), background, ball.label, settings);
    balls.push_back(std::move(ball));
  }
  settings.folds = 3;
  std::vector<KnownObject> none, objects(1);
  const LightFit alone = fit_light(balls, none, nullptr, sensor(), settings);
  ASSERT_EQ(alone.knowledge.size(), 8u);
  for (const std::size_t lamp : {0u, 4u}) EXPECT_FALSE(alone.knowledge[lamp + 1].told) << lamp;

  objects[0].known.name = "block";
  objects[0].view = block_view(0.3e-3, -0.2e-3);
  const auto inside = [](int x, int y) { return std::max(std::abs(x - 60), std::abs(y - 60)) < 45; };
  objects[0].samples = make_samples(
      noisy_photograph(light, objects[0].view, 99u), background, "block", inside,
      [&](int x, int y) { return !inside(x, y); }, 2);
  const LightFit both = fit_light(balls, objects, nullptr, sensor(), settings);
  for (std::size_t l = 0; l < 2; ++l) {
    const LampKnowledge *at = &both.knowledge[4 * l], &high = at[1], &wide = at[3];
    EXPECT_TRUE(at->told && high.told && wide.told) << l;
    EXPECT_NEAR(at->value, azimuth[l], 2.0 * at->sigma) << l;
    EXPECT_NEAR(high.value, elevation[l], 2.0 * high.sigma) << l;
    EXPECT_NEAR(at[2].value, std::log(20e-3), 2.0 * at[2].sigma) << l;
    EXPECT_NEAR(wide.value, width[l], 2.0 * wide.sigma) << l;
    EXPECT_LT(high.sigma, 0.1) << l;
  }
  EXPECT_LT(objects[0].rmse_codes, 1.6);
  EXPECT_GT(objects[0].left_out_blocks_rmse_codes, 1.001 * objects[0].rmse_codes);
  EXPECT_GT(objects[0].left_out_rmse_codes, objects[0].left_out_blocks_rmse_codes);
}

TEST(ActiveSamples, AreClippedOnesOnlyWhereTheLightDoesNotReachTheClip) {
  Samples samples;
  samples.target = Codes::Constant(3, 3, -100.0);
  samples.used = Codes::Zero(3, 3);
  samples.clipped = Codes::Zero(3, 3);
  samples.used(0, 0) = 1.0;
  samples.clipped(1, 0) = -1.0;  // black: a change of −100 or less
  samples.clipped(2, 0) = 1.0;   // white: −100 or more
  EXPECT_EQ(active_samples(samples, Codes::Constant(3, 3, -90.0)).col(0), Vector3(1, 1, 0));
  EXPECT_EQ(active_samples(samples, Codes::Constant(3, 3, -110.0)).col(0), Vector3(1, 0, 1));
}

TEST(FitLight, FewerBallsThanFoldsIsSaid) {
  CalibrateConfig settings = config();
  settings.folds = 9;
  std::vector<Ball> balls = synthetic_balls(true_light(), settings);
  std::vector<KnownObject> objects;
  EXPECT_EQ(message_of<DataError>([&] { fit_light(balls, objects, nullptr, sensor(), settings); }),
            "8 photographs cannot be divided into 9 folds");
}

TEST(NormalEquations, ResidualAndPartsAreThoseOfTheRows) {
  Eigen::MatrixXd features(6, 3);
  features << 1, 0, 2, 1, 1, 0, 1, 2, 1, 1, 3, 5, 1, 4, 1, 1, 5, 3;
  Samples samples;
  samples.target = Codes::Random(6, 3);
  samples.used = Codes::Ones(6, 3);
  samples.used(2, 1) = 0.0;
  const NormalEquations equations = normal_equations(features, samples, samples.used);
  const Codes weights = equations.part(0, 2).solve(0.0);
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::MatrixXd a = features.leftCols(2).array().colwise() * samples.used.col(c).array();
    const Eigen::VectorXd y = samples.target.col(c).cwiseProduct(samples.used.col(c));
    const Eigen::VectorXd w = a.colPivHouseholderQr().solve(y);
    EXPECT_NEAR((weights.col(c) - w).norm(), 0.0, 1e-12);
    EXPECT_NEAR(equations.part(0, 2).residual(weights)[static_cast<std::size_t>(c)], (a * w - y).squaredNorm(), 1e-12);
  }
  EXPECT_EQ(equations.count[1], 5.0);
  features.col(2) = 2.0 * features.col(1);
  EXPECT_EQ(message_of<SolverError>([&] { normal_equations(features, samples, samples.used).solve(0.0); }),
            "the photographs do not determine all weights of the light: give more of them or a larger ridge");
}

}  // namespace fit_light_test
}  // namespace tacipc
