#include "common/optics/develop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "common/base/rng.h"

namespace tacipc {
namespace develop_test {

const Response kSrgb{.mean_level = 0.5, .curve = "srgb"}, kLinear{.mean_level = 0.5, .curve = "linear"};

FloatImage ramp(int width, int height) {
  FloatImage image(width, height, 3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.2f + 0.001f * static_cast<float>(i % 997);
  return image;
}

TEST(CodeOf, FollowsTheSrgbCurve) {
  EXPECT_NEAR(code_of(0.0031308, kSrgb), 255 * 0.04045, 1e-3);
  EXPECT_NEAR(code_of(0.5, kSrgb), 187.516, 1e-3);
  EXPECT_DOUBLE_EQ(code_of(1.0, kSrgb), 255.0);
  EXPECT_DOUBLE_EQ(code_of(0.25, kLinear), 63.75);
  EXPECT_GT(code_of(1.5, kSrgb), 255.0);
}

TEST(SolveExposure, ReachesTheMeanLevelAfterTheCurve) {
  const FloatImage image = ramp(40, 30);
  for (const char* curve : {"srgb", "linear"}) {
    for (const double level : {0.1, 0.45, 0.9}) {
      const double exposure = solve_exposure(image, {.mean_level = level, .curve = curve});
      double sum = 0.0;
      for (const float v : image.pixels)
        sum += std::min(code_of(exposure * v, {.mean_level = level, .curve = curve}), 255.0);
      EXPECT_NEAR(sum / static_cast<double>(image.pixels.size()), 255.0 * level, 1e-9) << curve << " " << level;
    }
  }
}

TEST(SolveExposure, RefusesDarkness) {
  EXPECT_THAT([] { solve_exposure(FloatImage(4, 4, 3), {.mean_level = 0.5, .curve = "srgb"}); },
              ::testing::ThrowsMessage<DataError>("no light reaches the front face: check the positions of the LEDs"));
  FloatImage mostly_black(4, 4, 3);
  mostly_black.at(1, 2, 0) = 1.0f;
  EXPECT_THAT(
      [&] { solve_exposure(mostly_black, {.mean_level = 0.5, .curve = "srgb"}); },
      ::testing::ThrowsMessage<DataError>("no exposure gives the mean level 0.5: too much of the image is black"));
}

TEST(TransferNoise, EqualSimulationsReturnTheReference) {
  ByteImage reference(16, 16, 3);
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) reference.pixels[i] = static_cast<std::uint8_t>(i % 256);
  const FloatImage codes = encode(ramp(16, 16), 0.7, {.mean_level = 0.5, .curve = "srgb"});
  const TactileImage out = transfer_noise(reference, codes, codes);
  EXPECT_EQ(out.image.pixels, reference.pixels);
  EXPECT_EQ(out.clipped_fraction, 0.0);
}

TEST(TransferNoise, AddsTheDifferenceRoundsOnceAndClamps) {
  ByteImage reference(4, 1, 1);
  reference.pixels = {100, 250, 3, 100};
  FloatImage simulated(4, 1, 1), without(4, 1, 1);
  simulated.pixels = {60.4f, 90.0f, 20.0f, 10.6f};
  without.pixels = {50.2f, 80.0f, 30.0f, 10.0f};
  const TactileImage out = transfer_noise(reference, simulated, without);
  EXPECT_EQ(out.image.pixels, (std::vector<std::uint8_t>{110, 255, 0, 101}));
  EXPECT_DOUBLE_EQ(out.clipped_fraction, 0.5);
}

TEST(CodeOf, HasAnInverseForEveryCurve) {
  for (const Response& response : {kSrgb, kLinear, Response{.curve = "gamma", .gamma = 1.8}}) {
    for (const double code : {0.0, 3.0, 10.0, 127.5, 255.0})
      EXPECT_NEAR(code_of(value_of(code, response), response), code, 1e-10) << response.curve;
  }
  EXPECT_NEAR(code_of(0.25, {.curve = "gamma", .gamma = 2.0}), 127.5, 1e-12);
  EXPECT_EQ(code_of(-0.1, kSrgb), 0.0);
}

TEST(Encode, GivesEveryPixelItsCode) {
  constexpr double kExposure = 0.7;
  FloatImage signal(7, 3, 3);  // rows that are no multiple of eight
  for (std::size_t i = 0; i < signal.pixels.size(); ++i)
    signal.pixels[i] = static_cast<float>(1e-6 * std::pow(1.3, static_cast<double>(i)));
  signal.pixels[5] = 0.0f;
  signal.pixels[6] = -0.2f;
  signal.pixels[8] = 1e-30f;
  FloatImage other = signal;
  other.pixels[4] = other.pixels[20] = other.pixels[62] = 0.5f;
  for (const Response& response :
       {kSrgb, kLinear, Response{.curve = "gamma", .gamma = 1.8}, Response{.curve = "gamma", .gamma = 0.2}}) {
    const auto expect_codes = [&](const FloatImage& of, const FloatImage& codes) {
      ASSERT_EQ(codes.pixels.size(), of.pixels.size());
      for (std::size_t i = 0; i < of.pixels.size(); ++i)
        EXPECT_FLOAT_EQ(codes.pixels[i], static_cast<float>(code_of(kExposure * of.pixels[i], response))) << i;
    };
    const FloatImage codes = encode(signal, kExposure, response);
    expect_codes(signal, codes);
    expect_codes(other, encode(other, kExposure, response, {signal, codes}));
  }
}

TEST(CameraSignal, VignettesBalancesAndMixes) {
  FloatImage image(5, 3, 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(c + 1);
    }
  }
  Camera camera{.width_px = 5, .height_px = 3};
  camera.vignetting = {-0.5, 0.1};
  Response response = kLinear;
  response.white_balance = {2.0, 1.0, 0.5};
  response.color_matrix = {1, 0, 0, 0.5, 1, 0, 0, -1, 2};
  const FloatImage signal = camera_signal(image, camera, response);
  EXPECT_FLOAT_EQ(signal.at(2, 1, 0), 2.0f);  // the middle: no falloff
  EXPECT_FLOAT_EQ(signal.at(2, 1, 1), 0.5f * 2.0f + 2.0f);
  EXPECT_FLOAT_EQ(signal.at(2, 1, 2), -2.0f + 2.0f * 1.5f);
  const double rr = (2.0 * 2.0 + 1.0) / (2.5 * 2.5 + 1.5 * 1.5);
  EXPECT_NEAR(signal.at(4, 2, 0), 2.0 * (1.0 - 0.5 * rr + 0.1 * rr * rr), 1e-6);
}

TEST(SolveExposure, TakesWhatTheSensorFixes) {
  Response response = kSrgb;
  response.exposure = 0.125;
  EXPECT_EQ(solve_exposure(ramp(4, 4), response), 0.125);
}

TEST(TransferRatio, EqualSimulationsReturnTheReferenceAndRatiosScaleItsLight) {
  ByteImage reference(16, 16, 3);
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) reference.pixels[i] = static_cast<std::uint8_t>(i % 256);
  const FloatImage signal = ramp(16, 16);
  EXPECT_EQ(transfer_ratio(reference, signal, signal, 0.8, kSrgb).image.pixels, reference.pixels);
  FloatImage twice = signal;
  for (float& value : twice.pixels) value *= 2.0f;
  const TactileImage bright = transfer_ratio(reference, twice, signal, 0.8, kSrgb);
  const double expected = code_of(2.0 * value_of(100.0, kSrgb), kSrgb);
  EXPECT_EQ(bright.image.pixels[100], std::lround(expected));
  EXPECT_EQ(bright.image.pixels[255], 255);  // clamped, and counted
  EXPECT_GT(bright.clipped_fraction, 0.2);
  const FloatImage dark(16, 16, 3);  // without light there is no ratio: the difference counts
  EXPECT_EQ(transfer_ratio(reference, dark, dark, 0.8, kSrgb).image.pixels, reference.pixels);
}

TEST(Quantise, RoundsClampsAndCounts) {
  FloatImage codes(4, 1, 1);
  codes.pixels = {-3.0f, 0.6f, 254.4f, 300.0f};
  const TactileImage out = quantise(codes);
  EXPECT_EQ(out.image.pixels, (std::vector<std::uint8_t>{0, 1, 254, 255}));
  EXPECT_DOUBLE_EQ(out.clipped_fraction, 0.5);
}

TEST(SyntheticReference, HasTheNoiseOfItsModel) {
  constexpr int kSide = 200;
  const FloatImage flat(kSide, kSide, 1, 0.4f);
  const Response response{.mean_level = 0.4, .curve = "linear"};
  const SensorNoise noise{.full_well_e = 5000, .read_e = 4};
  const ByteImage image = synthetic_reference(flat, 1.0, response, noise, 7);
  double sum = 0.0, squares = 0.0;
  for (const std::uint8_t code : image.pixels) {
    sum += code;
    squares += code * code;
  }
  const double count = kSide * kSide, mean = sum / count, variance = squares / count - mean * mean;
  // Electrons: mean 2000, variance 2000 + 16; rounding to codes adds 1/12.
  const double scale = 255.0 / 5000.0, expected = 2016.0 * scale * scale + 1.0 / 12.0;
  EXPECT_NEAR(mean, 102.0, 4.0 * std::sqrt(expected / count));
  EXPECT_NEAR(variance / expected, 1.0, 0.04);
  EXPECT_EQ(image.pixels, synthetic_reference(flat, 1.0, response, noise, 7).pixels);
  EXPECT_NE(image.pixels, synthetic_reference(flat, 1.0, response, noise, 8).pixels);
}

TEST(Random, IsUniformNormalAndIndependentOfItsNeighbours) {
  constexpr int kCount = 100000;
  double uniform = 0.0, first = 0.0, second = 0.0, fourth = 0.0, lagged = 0.0, across = 0.0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double u = random_uniform(1, 2, i), n = random_normal(1, 2, i);
    ASSERT_TRUE(u > 0.0 && u < 1.0);
    uniform += u;
    first += n;
    second += n * n;
    fourth += n * n * n * n;
    lagged += n * random_normal(1, 2, i + 1);
    across += n * random_normal(1, 3, i);
  }
  // Five standard deviations of each mean.
  EXPECT_NEAR(uniform / kCount, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / kCount));
  EXPECT_NEAR(first / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(second / kCount, 1.0, 5.0 * std::sqrt(2.0 / kCount));
  EXPECT_NEAR(fourth / kCount, 3.0, 5.0 * std::sqrt(96.0 / kCount));
  EXPECT_NEAR(lagged / kCount, 0.0, 5.0 / std::sqrt(kCount));
  EXPECT_NEAR(across / kCount, 0.0, 5.0 / std::sqrt(kCount));
}

}  // namespace develop_test
}  // namespace tacipc
