#include "stages/study/metrics/ssim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "common/benchmark/metrics_rows.h"
#include "stages/study/metrics/image_error.h"
#include "tests/stages/study/metrics/test_images.h"

namespace tacipc {
namespace ssim_test {

TEST(Ssim, ConstantImagesByHand) {
  // No variance: only the luminance term is left.
  const ByteImage a(20, 15, 3, 100), b(20, 15, 3, 110);
  const double c1 = 2.55 * 2.55, expected = (2.0 * 100 * 110 + c1) / (100.0 * 100 + 110.0 * 110 + c1);
  EXPECT_NEAR(expected, 0.9954764441, 1e-10);
  EXPECT_NEAR(ssim(a, b, gaussian_window()), expected, 1e-12);
  EXPECT_NEAR(ssim(a, b, box_window()), expected, 1e-12);
}

TEST(Ssim, IsOneForEqualImagesAndSymmetric) {
  const ByteImage a = pattern_image(40, 30), b = changed(a, "noise");
  for (const SsimWindow& window : {gaussian_window(), box_window()}) {
    EXPECT_NEAR(ssim(a, a, window), 1.0, 1e-14);
    EXPECT_NEAR(ssim(a, b, window), ssim(b, a, window), 1e-14);
  }
}

TEST(Ssim, WindowsAreNormalisedAndOfTheirSize) {
  for (const SsimWindow& window : {gaussian_window(), box_window()})
    EXPECT_NEAR(std::accumulate(window.weights.begin(), window.weights.end(), 0.0), 1.0, 1e-15);
  EXPECT_EQ(gaussian_window().size(), 11);
  EXPECT_EQ(box_window().size(), 7);
  EXPECT_DOUBLE_EQ(box_window().covariance_factor, 49.0 / 48.0);
}

TEST(Ssim, OnlyWholeWindowsCount) {
  // The corner pixel lies in one of the 26 x 26 windows of one of three channels: the mean keeps all the others.
  const ByteImage a(32, 32, 3, 90);
  ByteImage b = a;
  b.at(0, 0, 1) = 190;
  const double c1 = 2.55 * 2.55, c2 = 7.65 * 7.65, mean = 90 + 100.0 / 49;
  const double variance = 100.0 * 100 / 49;  // of one pixel off by 100 among 49: 100² (1/49 − 1/49²) · 49/48
  const double touched = (2 * 90 * mean + c1) * c2 / ((90.0 * 90 + mean * mean + c1) * (variance + c2));
  EXPECT_NEAR(ssim(a, b, box_window()), 1.0 - (1.0 - touched) / (3 * 26 * 26), 1e-12);
}

TEST(ImageError, ByHand) {
  ByteImage a(2, 1, 1), b(2, 1, 1);
  a.at(0, 0, 0) = 255;
  a.at(1, 0, 0) = 10;
  b.at(1, 0, 0) = 61;
  const ImageError error = image_error(a, b);
  EXPECT_DOUBLE_EQ(error.mae, (255 + 51) / 2.0 / 255);
  EXPECT_DOUBLE_EQ(error.mse, (1.0 + 0.04) / 2);
  EXPECT_DOUBLE_EQ(psnr_db(0.01), 20.0);
  EXPECT_NEAR(psnr_ln(std::exp(-2.0)), 20.0, 1e-14);
  EXPECT_TRUE(std::isinf(psnr_db(image_error(a, a).mse)));
}

}  // namespace ssim_test
}  // namespace tacipc
