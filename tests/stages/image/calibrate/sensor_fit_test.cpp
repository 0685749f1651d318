#include "stages/image/calibrate/sensor_fit.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "common/base/error.h"
#include "common/optics/develop.h"
#include "stages/image/calibrate/led_intensities.h"
#include "stages/image/calibrate/rest_membrane.h"
#include "tests/common/optics/test_surfaces.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace sensor_fit_test {

/// MC-Tac's stack and ring with six of its LEDs lit, a small picture, no markers.
const std::string kSensorText = R"(name: ring
gel: {outline: disc, radius_mm: 15.0, thickness_mm: 2, ior: 1.41}
layers: [{name: acrylic, thickness_mm: 5.0, ior: 1.49}]
material: {law: neo_hookean, density_kg_m3: 1010, youngs_modulus_pa: 1.23e5, poissons_ratio: 0.43}
coating: {albedo: [0.5, 0.5, 0.5], specular_f0: 0.04, ggx_alpha: 0.4}
ambient: {rgb: [0, 0, 0]}
leds:
  ring:
    radius_mm: 10
    z_mm: -13
    count: 8
    lit:
      - {index: 0, rgb_linear: [1, 1, 1], intensity: 1}
      - {index: 1, group: red, rgb_linear: [1, 1, 1], intensity: 1}
      - {index: 3, group: green, rgb_linear: [1, 1, 1], intensity: 1}
      - {index: 4, group: green, rgb_linear: [1, 1, 1], intensity: 1}
      - {index: 6, group: blue, rgb_linear: [1, 1, 1], intensity: 1}
      - {index: 7, group: blue, rgb_linear: [1, 1, 1], intensity: 0.8}
camera: {model: rectified, position_mm: [0, 0, -12], width_px: 160, height_px: 120, window_mm: [15.0, 11.25]}
response: {mean_level: 0.45, curve: gamma, gamma: 2.2}
noise: {full_well_e: 5000, read_e: 4}
)";

const std::vector<std::array<double, 3>> kColors = {
    {0.30, 0.30, 0.30}, {1.0, 0.10, 0.05}, {0.05, 0.8, 0.15}, {0.0, 0.1, 0.9}};
constexpr double kAmbient = 30.0;

std::vector<FreeParameter> all_free() {
  return {{.name = "ring_radius_mm", .sigma = 0.5},   {.name = "ring_z_mm", .sigma = 1.0},
          {.name = "ring_azimuth_deg", .sigma = 3.0}, {.name = "camera_x_mm", .sigma = 0.3},
          {.name = "camera_y_mm", .sigma = 0.3},      {.name = "camera_rotation_z_deg", .sigma = 1.0},
          {.name = "vignetting_v2", .sigma = 0.2},    {.name = "gamma", .sigma = 0.2}};
}

/// As far from the nominal file as the issue wants, in prior deviations.
Eigen::VectorXd true_u() {
  Eigen::VectorXd u(8);
  u << 1.0, -1.0, 1.0, 0.8, -0.7, 0.9, -1.0, -1.0;
  return u;
}

Sensor lit(Sensor sensor) {
  const auto groups = light_groups(sensor.leds);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const int led : groups[g].leds) sensor.leds[static_cast<std::size_t>(led)].rgb = kColors[g];
  sensor.ambient_rgb = {kAmbient, kAmbient, kAmbient};
  return sensor;
}

constexpr TraceSettings kTrace{.subpixels = 2, .led_samples = 3};

double exposure_of(const Sensor& sensor) {
  const TraceResult traced = trace(rest_membrane(sensor.gel), sensor, kTrace);
  return solve_exposure(camera_signal(color_image(traced, sensor, false), sensor.camera, sensor.response),
                        sensor.response);
}

/// Eight bits, with shot and read noise of a stream of its own if noisy.
ByteImage photograph(const Sensor& sensor, const Membrane& membrane, double exposure, bool noisy,
                     std::uint64_t stream) {
  FloatImage signal =
      camera_signal(color_image(trace(membrane, sensor, kTrace), sensor, false), sensor.camera, sensor.response);
  if (noisy) signal = add_noise(signal, exposure, *sensor.noise, 11, stream);
  return quantise(encode(signal, exposure, sensor.response)).image;
}

class SensorFitTest : public testing::Test {
 protected:
  SensorParameters parameters(std::vector<FreeParameter> free = all_free()) const {
    return SensorParameters(scratch_.file("sensor.yaml", kSensorText), std::move(free));
  }
  const ScratchFolder scratch_;
};

SensorFitConfig config() { return {.block_px = 4, .sigma_codes = 0.3}; }

/// Each parameter and colour within four of its deviations.
void expect_found(const SensorParameters& free, const SensorFit& fit, const Eigen::VectorXd& truth, double exposure) {
  for (Eigen::Index i = 0; i < free.count(); ++i)
    EXPECT_LT(std::abs(fit.u[i] - truth[i]), 4.0 * std::sqrt(fit.covariance(i, i))) << free.name(i) << " " << fit.u[i];
  for (Eigen::Index c = 0; c < 3; ++c) {
    for (Eigen::Index g = 0; g < fit.rgb.rows(); ++g) {
      const double color = kColors[static_cast<std::size_t>(g)][static_cast<std::size_t>(c)];
      EXPECT_LT(std::abs(fit.rgb(g, c) / exposure - color), 4.0 * fit.color_sigma(g, c) / exposure) << g << " " << c;
    }
    EXPECT_LT(std::abs(fit.veil[c] / exposure - kAmbient), 4.0 * fit.color_sigma(fit.rgb.rows(), c) / exposure) << c;
  }
}

TEST_F(SensorFitTest, FindsAPerturbedSensorInOneNoisyPhotograph) {
  const SensorParameters free = parameters();
  const Sensor truth = lit(free.sensor(true_u()));
  const double exposure = exposure_of(truth);
  const SensorFit fit =
      fit_sensor(free, config(), photograph(truth, rest_membrane(truth.gel), exposure, true, 1), {}, nullptr);
  EXPECT_TRUE(fit.converged);
  expect_found(free, fit, true_u(), exposure);
  // In millimetres, degrees, 1: a tenth of what was changed where the photograph tells, at least a third.
  const std::map<std::string, double> within{{"ring_radius_mm", 0.17}, {"ring_z_mm", 0.2},      {"camera_x_mm", 0.08},
                                             {"camera_y_mm", 0.07},    {"vignetting_v2", 0.03}, {"gamma", 0.07}};
  for (Eigen::Index i = 0; i < free.count(); ++i)
    if (const auto limit = within.find(free.name(i)); limit != within.end()) {
      EXPECT_NEAR(free.value(i, fit.u[i]), free.value(i, true_u()[i]), limit->second) << free.name(i);
    }
  // A turn of camera and ring together shows nowhere: what is known of the two is their difference, and the prior.
  EXPECT_GT(fit.covariance(5, 5), 0.5);
  EXPECT_LT(fit.covariance(2, 2), 0.5);
  const double difference = 3.0 * (fit.u[2] - true_u()[2]) - (fit.u[5] - true_u()[5]);
  EXPECT_NEAR(difference, 0.0, 0.4);
  // Eight bits and the noise of 16 pixels' middle half: nothing is left to explain.
  for (const double rmse : fit.photographs[0].rmse_codes) EXPECT_NEAR(rmse, 0.5, 0.1);
  EXPECT_GT(fit.condition, 1.0);
  EXPECT_GT(fit.condition_with_veil, fit.condition_leds);
  EXPECT_EQ(fit.outliers, 0u);
}

TEST_F(SensorFitTest, FindsACurvedSensorWithAPinholeCamera) {
  const SensorParameters free(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/digit.yaml",
                              {{.name = "ring_azimuth_deg", .sigma = 3.0},
                               {.name = "camera_x_mm", .sigma = 0.3},
                               {.name = "camera_rotation_x_deg", .sigma = 1.0},
                               {.name = "vignetting_v2", .sigma = 0.2}});
  const Eigen::Vector4d true_values(0.9, -0.8, 1.1, -0.7);
  const Sensor truth = free.sensor(true_values);
  const double exposure = exposure_of(truth);
  SensorFitConfig coarse = config();
  coarse.block_px = 8;
  const SensorFit fit =
      fit_sensor(free, coarse, photograph(truth, rest_membrane(truth.gel), exposure, true, 1), {}, nullptr);
  EXPECT_TRUE(fit.converged);
  for (Eigen::Index i = 0; i < free.count(); ++i) {
    EXPECT_LT(std::abs(fit.u[i] - true_values[i]), 4.0 * std::sqrt(fit.covariance(i, i))) << free.name(i);
    EXPECT_LT(fit.covariance(i, i), 0.05) << free.name(i);
  }
}

TEST_F(SensorFitTest, ColoursOfAKnownGeometryAreWithinTwoPercent) {
  const SensorParameters free = parameters({});
  const Sensor truth = lit(free.nominal());
  const double exposure = exposure_of(truth);
  const SensorFit fit =
      fit_sensor(free, config(), photograph(truth, rest_membrane(truth.gel), exposure, true, 1), {}, nullptr);
  expect_found(free, fit, Eigen::VectorXd(), exposure);
  for (Eigen::Index g = 0; g < fit.rgb.rows(); ++g)
    for (Eigen::Index c = 0; c < 3; ++c) {
      const double color = kColors[static_cast<std::size_t>(g)][static_cast<std::size_t>(c)];
      EXPECT_NEAR(fit.rgb(g, c) / exposure, color, 0.02 * std::max(color, 0.5)) << g << " " << c;
    }
}

TEST_F(SensorFitTest, TheFittedFileMakesThePhotograph) {
  const SensorParameters free = parameters();
  const Sensor truth = lit(free.sensor(true_u()));
  const double exposure = exposure_of(truth);
  const ByteImage seen = photograph(truth, rest_membrane(truth.gel), exposure, false, 0);
  const SensorFit fit = fit_sensor(free, config(), seen, {}, nullptr);
  const std::string text =
      changed_sensor(scratch_ / "sensor.yaml", fitted_changes(free, fit, "reference.png"), "made by a test");
  const auto again = config_from_text<Sensor>(text, "sensor.yaml");
  EXPECT_EQ(*again.reference_image, "reference.png");
  double brightest = 0.0;
  for (const Led& led : again.leds) brightest = std::max({brightest, led.rgb[0], led.rgb[1], led.rgb[2]});
  EXPECT_EQ(brightest, 1.0);
  EXPECT_EQ(again.leds[5].intensity, 0.8);
  const ByteImage made = photograph(again, rest_membrane(again.gel), *again.response.exposure, false, 0);
  int worst = 0;
  double squares = 0.0;
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    const int off = int{made.pixels[i]} - int{seen.pixels[i]};
    worst = std::max(worst, std::abs(off));
    squares += off * off;
  }
  EXPECT_LE(worst, 1);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(seen.pixels.size())), 0.35);
}

TEST_F(SensorFitTest, DustAndClippingDoNotCount) {
  const SensorParameters free = parameters();
  const Sensor truth = lit(free.sensor(true_u()));
  const double exposure = exposure_of(truth);
  ByteImage seen = photograph(truth, rest_membrane(truth.gel), exposure, true, 1);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x)
      for (int c = 0; c < 3; ++c) {
        seen.at(50 + x, 60 + y, c) = 90;
        seen.at(100 + x, 30 + y, c) = 255;
      }
  const SensorFit fit = fit_sensor(free, config(), seen, {}, nullptr);
  EXPECT_GE(fit.outliers, 12u);  // nine whole blocks in at least one channel each, and some more at the edge
  EXPECT_LE(fit.outliers, 60u);
  EXPECT_LE(fit.photographs[0].blocks[0], 1200u - 9u);
  EXPECT_TRUE(std::isnan(fit.photographs[0].residual.at(26, 8, 0)));
  expect_found(free, fit, true_u(), exposure);
}

TEST_F(SensorFitTest, WhatNothingExplainsLeavesThePriorsInForce) {
  const SensorParameters free = parameters();
  const Sensor truth = lit(free.nominal());
  const double exposure = exposure_of(truth);
  ByteImage seen = photograph(truth, rest_membrane(truth.gel), exposure, true, 1);
  // Ripples that no LED makes.
  for (int y = 0; y < seen.height; ++y)
    for (int x = 0; x < seen.width; ++x)
      for (int c = 0; c < 3; ++c)
        seen.at(x, y, c) = static_cast<std::uint8_t>(std::clamp<long>(
            std::lround(seen.at(x, y, c) + 12.0 * std::sin(0.25 * x + c) * std::sin(0.2 * y)), 1, 254));
  const SensorFit fit = fit_sensor(free, config(), seen, {}, nullptr);
  EXPECT_GT(fit.sigma_codes, 4.0);  // a half of the ripples' amplitude
  EXPECT_LT(fit.u.cwiseAbs().maxCoeff(), 2.0);
  const SensorFit clear =
      fit_sensor(free, config(), photograph(truth, rest_membrane(truth.gel), exposure, true, 1), {}, nullptr);
  EXPECT_GT(fit.covariance(1, 1), 4.0 * clear.covariance(1, 1));
}

/// A ball's cap down to where it has left, then a smooth fall-off: pressed shapes of known place and depth.
BallPress cap_press(double radius) {
  constexpr int kSide = 61;
  BallPress press;
  press.radius_m = radius;
  for (int k = 0; k <= 8; ++k) {
    const double depth = 1e-4 * k, a = std::sqrt(radius * depth);
    Positions front(kSide * kSide, 3);
    for (int i = 0; i < kSide * kSide; ++i) {
      const double x = 1.3e-4 * (i % kSide - 30), y = 1.3e-4 * (i / kSide - 30), r = std::hypot(x, y);
      const auto sphere = [&](double at) { return radius - std::sqrt(radius * radius - at * at); };
      const double edge = depth - sphere(a);
      const double in =
          r < a ? depth - sphere(r) : edge * std::exp(-a / std::sqrt(radius * radius - a * a) / edge * (r - a));
      front.row(i) << x, y, k == 0 ? 0.0 : -in;
    }
    press.depth_m.push_back(depth);
    press.frames.push_back(front);
  }
  press.front.resize(2 * (kSide - 1) * (kSide - 1), 3);
  for (int j = 0, t = 0; j + 1 < kSide; ++j)
    for (int i = 0; i + 1 < kSide; ++i) {
      const int at = kSide * j + i;
      press.front.row(t++) << at, at + 1, at + kSide + 1;
      press.front.row(t++) << at, at + kSide + 1, at + kSide;
    }
  press.set_rim(10e-6);
  return press;
}

TEST_F(SensorFitTest, BallsTellTheHeightFromTheStrength) {
  const SensorParameters free = parameters({{.name = "ring_radius_mm", .sigma = 0.5},
                                            {.name = "ring_z_mm", .sigma = 1.0},
                                            {.name = "window_scale", .sigma = 0.03},
                                            {.name = "specular_f0", .sigma = 0.01}});
  const Eigen::Vector4d true_values(1.0, -1.0, 0.7, -0.8);
  const Sensor truth = lit(free.sensor(true_values));
  const double exposure = exposure_of(truth);
  const BallPress press = cap_press(3e-3);
  const std::vector<Eigen::Vector3d> slips = {{0.6, -0.4, 0.5}, {-0.5, 0.3, -0.4}};
  std::vector<BallPhotograph> balls;
  for (int i = 0; i < 2; ++i) {
    const BallLabel label{
        .image = fmt::format("b{}", i), .x_px = 60.0 + 35 * i, .y_px = 45.0 + 25 * i, .radius_px = 10.0 + 1.5 * i};
    const BallPlace place = ball_place(press, label, slips[static_cast<std::size_t>(i)], truth);
    const Eigen::RowVector3d shift(place.x_m, place.y_m, 0.0);
    // Around the pressed piece lies the gel at rest.
    const Positions pressed = press.at_depth(place.depth_m).rowwise() + shift;
    balls.push_back({photograph(truth, make_membrane(pressed, press.frames[0], press.front), exposure, true,
                                static_cast<std::uint64_t>(2 + i)),
                     label});
  }
  const ByteImage background = photograph(truth, rest_membrane(truth.gel), exposure, true, 1);
  SensorFitConfig with = config();
  with.block_px = 2;  // a contact is ten blocks wide; at five the blocks' middles no longer stand for what is in them
  with.subpixels = 1;
  with.balls = FitBalls{.radius_m = 3e-3, .contact_gap_m = 10e-6, .label_sigma_px = 0.5, .fit_radius_px = 22};
  const SensorFit alone = fit_sensor(free, config(), background, {}, nullptr);
  const SensorFit fit = fit_sensor(free, with, background, balls, &press);
  expect_found(free, fit, true_values, exposure);
  for (const Eigen::Index i : {0, 1, 2}) EXPECT_LT(fit.covariance(i, i), 0.5 * alone.covariance(i, i)) << free.name(i);
  EXPECT_NEAR(free.value(0, fit.u[0]), free.value(0, 1.0), 0.2);   // mm
  EXPECT_NEAR(free.value(1, fit.u[1]), free.value(1, -1.0), 0.3);  // mm
  ASSERT_EQ(fit.balls.size(), 2u);
  for (std::size_t i = 0; i < fit.balls.size(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k) {
      EXPECT_LT(std::abs(fit.balls[i].offsets_px[k] - slips[i][k]), 4.0 * fit.balls[i].sigma_px[k]) << i << " " << k;
      EXPECT_LT(fit.balls[i].sigma_px[k], 0.15);  // of half a pixel known before
    }
}

/// Differences over a step and its half converge at second order to a derivative only where the light is smooth in
/// the parameter: then steps of a fiftieth of a deviation are derivatives.
TEST_F(SensorFitTest, TheLightIsSmoothInEveryParameter) {
  std::vector<FreeParameter> all = all_free();
  all[5].sigma = 6.0;  // a turn changes little: the light's single precision would show
  all.push_back({.name = "camera_z_mm", .sigma = 0.5});
  all.push_back({.name = "ring_tilt_deg", .sigma = 3.0, .mean = 5.0, .bounds = std::array{1.0, 20.0}});
  all.push_back({.name = "window_scale", .sigma = 0.05});
  all.push_back({.name = "vignetting_v4", .sigma = 0.1});
  all.push_back({.name = "specular_f0", .sigma = 0.01});
  all.push_back({.name = "ggx_alpha", .sigma = 0.05});
  const SensorParameters free = parameters(all);
  BlockTracer tracer(free.nominal(), 8, kTrace);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(free.count());
  const auto image = [&](Eigen::Index i, double at) -> Eigen::VectorXd {
    Eigen::VectorXd moved = u;
    moved[i] += at;
    return tracer.light(moved, free.sensor(moved), Eigen::Vector3d::Zero())[0].rowwise().sum();
  };
  for (Eigen::Index i = 0; i < free.count(); ++i) {
    const auto slope = [&](double step) -> Eigen::VectorXd { return (image(i, step) - image(i, -step)) / (2 * step); };
    const Eigen::VectorXd coarse = slope(0.8), middle = slope(0.4), fine = slope(0.2);
    const double size = middle.norm();
    if (free.name(i) == "gamma") {
      EXPECT_EQ(size, 0.0);  // of the curve, not of the light
      continue;
    }
    const double change = (coarse - middle).norm(), next = (middle - fine).norm();
    // Straight lines (vignetting, f0) have nothing to converge but rounding.
    if (change < 1e-5 * size) continue;
    EXPECT_NEAR(std::log2(change / next), 2.0, 0.1) << free.name(i) << " " << change / size;
  }
}

/// Known for 8 LEDs 10 mm behind a window of 15 × 11.25 mm, under 3 mm of air, 5 mm of acrylic and 2 mm of gel: 17.
/// Farther off they look more alike; a coating's lobe tells them apart.
TEST_F(SensorFitTest, EightLedsOfARingAreAsWellConditionedAsIsKnown) {
  std::string text = kSensorText;
  const std::string lobe = ", specular_f0: 0.04, ggx_alpha: 0.4";
  text.erase(text.find(lobe), lobe.size());
  const std::size_t lit = text.find("      - {index: 0");
  text.erase(lit, text.find("camera:") - lit);
  std::string leds;
  for (int i = 0; i < 8; ++i) leds += fmt::format("      - {{index: {}, rgb_linear: [1, 1, 1], intensity: 1}}\n", i);
  text.insert(lit, leds);
  const SensorParameters ring(scratch_.file("eight.yaml", text),
                              {{.name = "ring_z_mm", .sigma = 1.0, .bounds = std::array{-16.0, -9.0}}});
  BlockTracer tracer(ring.nominal(), 2, kTrace);
  const auto condition = [&](double u) {
    const Eigen::VectorXd key = Eigen::VectorXd::Constant(1, u);
    const Eigen::MatrixXd light = tracer.light(key, ring.sensor(key), Eigen::Vector3d::Zero())[0].leftCols(8);
    return condition_of(light.transpose() * light);
  };
  EXPECT_NEAR(condition(3.0), 17.0, 1.0);
  EXPECT_NEAR(condition(0.0), 61.0, 3.0);
}

TEST_F(SensorFitTest, RefusesWhatCannotBeFitted) {
  const SensorParameters free = parameters();
  const ByteImage grey(160, 120, 3, 100);
  SensorFitConfig odd = config();
  odd.block_px = 7;
  EXPECT_EQ(message_of<UsageError>([&] { fit_sensor(free, odd, grey, {}, nullptr); }),
            "sensor_fit.block_px: 7 does not divide the image's 160 x 120 pixels");
  EXPECT_EQ(message_of<DataError>([&] { fit_sensor(free, config(), ByteImage(160, 120, 3, 255), {}, nullptr); }),
            "channel 0: 0 blocks count for 4 colours and the veil");
  std::string dark = kSensorText;
  dark.replace(dark.find("intensity: 1}"), 12, "intensity: 0");
  const SensorParameters unlit(scratch_.file("dark.yaml", dark), {});
  EXPECT_EQ(message_of<DataError>([&] { fit_sensor(unlit, config(), grey, {}, nullptr); }),
            "LED 0 lights nothing in channel 0 that counts, so its colour cannot be determined");
}

}  // namespace sensor_fit_test
}  // namespace tacipc
