#include "stages/image/calibrate/led_intensities.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace led_intensities_test {

TEST(NonnegativeLeastSquares, StopsAtTheBoundByHand) {
  Eigen::MatrixXd a(3, 2);
  a << 1, 1, 1, 2, 1, 3;
  // Free optimum of y = (3, 2, 1): (4, −1). With the second held at 0 the first is the mean, 2.
  EXPECT_NEAR((nonnegative_least_squares(a, Eigen::Vector3d(3, 2, 1)) - Eigen::Vector2d(2, 0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((nonnegative_least_squares(a, Eigen::Vector3d(3, 5, 7)) - Eigen::Vector2d(1, 2)).norm(), 0.0, 1e-12);
  EXPECT_EQ(nonnegative_least_squares(a, Eigen::Vector3d(-1, -2, -3)).norm(), 0.0);
}

TEST(NonnegativeLeastSquares, MeetsTheOptimalityConditions) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Eigen::MatrixXd a(30, 8);
    Eigen::VectorXd y(30);
    for (Eigen::Index i = 0; i < a.size(); ++i) a.data()[i] = random_normal(seed, 1, static_cast<std::uint64_t>(i));
    for (Eigen::Index i = 0; i < 30; ++i) y[i] = random_normal(seed, 2, static_cast<std::uint64_t>(i));
    const Eigen::VectorXd x = nonnegative_least_squares(a, y), slope = a.transpose() * (y - a * x);
    for (Eigen::Index i = 0; i < 8; ++i) {
      EXPECT_GE(x[i], 0.0);
      EXPECT_LE(slope[i], 1e-9) << seed;
      EXPECT_NEAR(x[i] * slope[i], 0.0, 1e-9) << seed;
    }
  }
}

constexpr int kWidth = 80, kHeight = 60, kLeds = 8;

/// Irradiance of eight Lambertian LEDs in a ring of 10 mm, 13 mm behind a front of 15 × 11.25 mm: I h² / r⁴ at unit
/// brightest.
std::vector<FloatImage> ring_basis(int scale = 1) {
  const int width = scale * kWidth, height = scale * kHeight;
  std::vector<FloatImage> basis;
  for (int l = 0; l < kLeds; ++l) {
    const double azimuth = 2 * std::numbers::pi * l / kLeds;
    FloatImage image(width, height, 3);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const double dx = (x + 0.5) / width * 15 - 7.5 - 10 * std::cos(azimuth);
        const double dy = (y + 0.5) / height * 11.25 - 5.625 - 10 * std::sin(azimuth);
        const double squared = dx * dx + dy * dy + 13 * 13;
        for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(1e4 / (squared * squared));
      }
    basis.push_back(image);
  }
  return basis;
}

FloatImage even_veil(const FloatImage& like) { return FloatImage(like.width, like.height, 1, 1.0f); }

double true_intensity(int led, int channel) { return led % 3 == channel ? 0.25 + 0.02 * led : 0.0; }
constexpr double kVeil = 0.02;

FloatImage codes_of(const std::vector<FloatImage>& basis, double noise, bool rounded) {
  const int width = basis[0].width, height = basis[0].height;
  FloatImage codes(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        double value = kVeil;
        for (int l = 0; l < kLeds; ++l) value += true_intensity(l, c) * basis[static_cast<std::size_t>(l)].at(x, y, 0);
        value += noise * random_normal(3, 1, static_cast<std::uint64_t>((y * width + x) * 3 + c));
        const double code = 255.0 * std::clamp(value, 0.0, 1.0);
        codes.at(x, y, c) = static_cast<float>(rounded ? std::round(code) : code);
      }
  return codes;
}

IntensityConfig linear_config() { return {.curve = "linear", .shot_gain = 1e-4, .read_noise = 1e-3, .block_px = 1}; }

TEST(FitIntensities, AreExactWithoutNoise) {
  const auto basis = ring_basis();
  const IntensityFit fit = fit_intensities(basis, even_veil(basis[0]), codes_of(basis, 0.0, false), linear_config());
  for (int l = 0; l < kLeds; ++l)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(fit.rgb(l, c), true_intensity(l, c), 2e-6) << l << " " << c;  // codes are floats
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(fit.veil[c], kVeil, 2e-6);
  EXPECT_LT(fit.condition, 100.0);  // 80 on straight rays; refraction lowers it
  EXPECT_GT(fit.condition, 5.0);
  EXPECT_GT(fit.condition_with_veil, fit.condition);  // a veil is nearly the sum of all LEDs
}

TEST(FitIntensities, AreWithinTwoPercentWithNoiseAndEightBits) {
  const auto basis = ring_basis(4);
  constexpr double kNoise = 0.004;  // one code
  const IntensityFit fit = fit_intensities(basis, even_veil(basis[0]), codes_of(basis, kNoise, true),
                                           {.curve = "linear", .shot_gain = 0.0, .read_noise = kNoise, .block_px = 1});
  for (int l = 0; l < kLeds; ++l)
    for (int c = 0; c < 3; ++c) {
      if (true_intensity(l, c) == 0.0) continue;
      EXPECT_NEAR(fit.rgb(l, c) / true_intensity(l, c), 1.0, 0.02) << l << " " << c;
      // And as far off as the covariance says, within four deviations.
      EXPECT_LT(std::abs(fit.rgb(l, c) - true_intensity(l, c)),
                4.0 * std::sqrt(fit.covariance[static_cast<std::size_t>(c)](l, l)));
    }
  EXPECT_NEAR(fit.rmse[0], std::hypot(kNoise, 1 / 255.0 / std::sqrt(12.0)), 2e-4);
}

TEST(FitIntensities, BlocksIgnoreDustAndClippingIsLeftOut) {
  const auto basis = ring_basis();
  FloatImage codes = codes_of(basis, 0.0, false);
  for (int i = 0; i < 40; ++i) codes.at((7 * i) % kWidth, (11 * i) % kHeight, i % 3) = 3.0f;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < kHeight; ++y) codes.at(x, y, 1) = 255.0f;
  IntensityConfig config = linear_config();
  config.block_px = 5;
  const IntensityFit fit = fit_intensities(basis, even_veil(basis[0]), codes, config);
  // Medians of a curved image are its value but for the curvature.
  for (int l = 0; l < kLeds; ++l) EXPECT_NEAR(fit.rgb(l, 1), true_intensity(l, 1), 0.01) << l;
  EXPECT_EQ(fit.residual.width, 16);
  const FloatImage white(kWidth, kHeight, 3, 255.0f);
  EXPECT_EQ(message_of<DataError>([&] { fit_intensities(basis, even_veil(basis[0]), white, config); }),
            "channel 0: 0 usable blocks for 9 unknowns");
}

}  // namespace led_intensities_test
}  // namespace tacipc
