#include "stages/image/calibrate/fit_table.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace fit_table_test {

constexpr int kWidth = 120, kHeight = 90;

/// The change that the photographs below show: linear in the slope, quadratic over the field.
std::array<double, 3> known(double slope_x, double slope_y, int x, int y) {
  const auto t = SlopeTable::terms(x, y, kWidth, kHeight);
  const double field = 1.0 + 0.3 * t[0] - 0.2 * t[1] + 0.1 * t[2] + 0.4 * t[3] - 0.25 * t[4];
  return {40.0 * slope_x * field, 30.0 * slope_y * field, 20.0 * (slope_x - slope_y) * field};
}

std::vector<std::vector<ContactPixel>> balls_of_known_light() {
  std::vector<std::vector<ContactPixel>> balls;
  const ByteImage grey(kWidth, kHeight, 3, 128);
  for (int i = 0; i < 12; ++i) {
    const int row = i / 4;
    const BallDisc disc{.x_px = 20.0 + 27.0 * (i % 4), .y_px = 18.0 + 27.0 * row, .contact_px = 16, .radius_px = 24};
    balls.push_back(disc_pixels(disc, grey, grey, {}));
    for (ContactPixel& pixel : balls.back()) pixel.target = known(pixel.slope_x, pixel.slope_y, pixel.x, pixel.y);
  }
  return balls;
}

TEST(BallDiscs, SlopesAreTheBallsAndRiseToItsCentre) {
  ByteImage photo(40, 30, 3, 130), background(40, 30, 3, 128);
  photo.at(23, 16, 1) = 255;
  const auto pixels =
      disc_pixels({.x_px = 20, .y_px = 12, .contact_px = 5.5, .radius_px = 13}, photo, background, {1.0, 0.0, -2.0});
  const auto found =
      std::find_if(pixels.begin(), pixels.end(), [](const ContactPixel& p) { return p.x == 23 && p.y == 16; });
  ASSERT_NE(found, pixels.end());
  EXPECT_NEAR(found->slope_x, -3.0 / 12.0, 1e-15);  // 3² + 4² + 12² = 13²
  EXPECT_NEAR(found->slope_y, -4.0 / 12.0, 1e-15);
  EXPECT_EQ(found->target[0], 1.0);
  EXPECT_EQ(found->target[2], 4.0);
  EXPECT_FALSE(found->used[1]);
  EXPECT_FALSE(found->all_used());
  EXPECT_TRUE(found->used[0]);
  for (const ContactPixel& p : pixels) EXPECT_LT(std::hypot(p.x - 20.0, p.y - 12.0), 5.5);
  EXPECT_EQ(disc_pixels({.x_px = 20, .y_px = 12, .contact_px = 9, .radius_px = 1.5}, photo, background, {}).size(), 9U)
      << "a ball ends where it does";
}

// As published, where offsets from a ball's labelled centre are whole numbers and know no −0.
TEST(BallDiscs, TheCentresRowAndColumnHaveThePublishedDirections) {
  const ByteImage grey(40, 30, 3, 128);
  const SlopeTable table(125);
  const auto direction = [&](int x, int y) {
    for (const ContactPixel& p :
         disc_pixels({.x_px = 20, .y_px = 12, .contact_px = 5, .radius_px = 13}, grey, grey, {}))
      if (p.x == x && p.y == y) return table.direction_bin(p.slope_x, p.slope_y);
    return -1;
  };
  EXPECT_EQ(direction(20, 12), 62);   // atan2(0, 0) = 0
  EXPECT_EQ(direction(23, 12), 124);  // atan2(0, −3) = π
  EXPECT_EQ(direction(17, 12), 62);   // atan2(0, 3) = 0
  EXPECT_EQ(direction(20, 9), 93);    // atan2(3, 0) = π/2
  EXPECT_EQ(direction(20, 15), 31);   // atan2(−3, 0) = −π/2
}

TEST(ObjectPixels, AreThoseWhoseNeighboursAreInTheGel) {
  ByteImage photo(12, 9, 3, 130);
  const ByteImage background(12, 9, 3, 128);
  photo.at(5, 4, 2) = 0;
  FloatImage height(12, 9, 1);
  for (int y = 2; y < 7; ++y)
    for (int x = 3; x < 9; ++x) height.at(x, y, 0) = static_cast<float>(1e-3 + 1e-4 * x - 0.5e-4 * y);
  const auto pixels = object_pixels(height, 2e-4, photo, background, {1.0, 0.0, -2.0});
  EXPECT_EQ(pixels.size(), 12U);  // 4 × 3 of 6 × 5
  for (const ContactPixel& pixel : pixels) {
    EXPECT_NEAR(pixel.slope_x, 0.5, 1e-6);
    EXPECT_NEAR(pixel.slope_y, -0.25, 1e-6);
    EXPECT_EQ(pixel.target[0], 1.0);
    EXPECT_EQ(pixel.used[2], !(pixel.x == 5 && pixel.y == 4));
  }
}

TEST(NearestMarked, IsTheLeastDistanceOfIndices) {
  std::vector<bool> marked(49, false);
  marked[1 * 7 + 1] = marked[5 * 7 + 6] = true;
  const auto flat = nearest_marked(marked, 7, false);
  EXPECT_EQ(flat[8], 8U);
  EXPECT_EQ(flat[1 * 7 + 6], 41U);  // 4² against 5²
  EXPECT_EQ(flat[0], 8U);
  EXPECT_EQ(nearest_marked(marked, 7, true)[1 * 7 + 6], 8U) << "one step around the circle of six";
}

TEST(FitTable, AKnownQuadraticComesBackFromEveryPixel) {
  const auto balls = balls_of_known_light();
  const SlopeTable table =
      fit_table(balls, kWidth, kHeight, {.bins = 61, .pooled = true, .smoothing_bins = 0.0, .ridge = 1e-9});
  double squares = 0.0, size = 0.0;
  for (const auto& pixels : balls)
    for (const ContactPixel& p : pixels) {
      const auto codes = table.change(p.slope_x, p.slope_y, SlopeTable::terms(p.x, p.y, kWidth, kHeight));
      for (std::size_t c = 0; c < 3; ++c) squares += std::pow(codes[c] - p.target[c], 2);
      for (std::size_t c = 0; c < 3; ++c) size += p.target[c] * p.target[c];
    }
  EXPECT_LT(std::sqrt(squares / size), 0.05) << "a bin's width";
  // Between the balls, at a slope that they have, the polynomial of the bin holds.
  const double slope = 0.5;
  const auto codes = table.change(slope, 0.0, SlopeTable::terms(33, 31, kWidth, kHeight));
  EXPECT_NEAR(codes[0], known(slope, 0.0, 33, 31)[0], 2.0);
}

TEST(FitTable, AsReleasedOnePixelOfEachBallTellsTheBin) {
  auto balls = balls_of_known_light();
  const TableFit released{.bins = 61};
  const SlopeTable table = fit_table(balls, kWidth, kHeight, released);
  const auto codes = table.change(0.5, 0.0, SlopeTable::terms(60, 45, kWidth, kHeight));
  EXPECT_NEAR(codes[0], known(0.5, 0.0, 60, 45)[0], 2.0);
  // Of the pixels of a bin the last counts: others may say anything.
  const SlopeTable bins(61);
  for (auto& pixels : balls)
    for (std::size_t i = 0; i < pixels.size(); ++i)
      for (std::size_t k = i + 1; k < pixels.size(); ++k)
        if (bins.inclination_bin(std::hypot(pixels[i].slope_x, pixels[i].slope_y)) ==
                bins.inclination_bin(std::hypot(pixels[k].slope_x, pixels[k].slope_y)) &&
            bins.direction_bin(pixels[i].slope_x, pixels[i].slope_y) ==
                bins.direction_bin(pixels[k].slope_x, pixels[k].slope_y))
          pixels[i].target = {99.0, 99.0, 99.0};
  EXPECT_EQ(fit_table(balls, kWidth, kHeight, released).weights, table.weights);
}

TEST(FitTable, AsReleasedAFlatPixelIsChangedAsTheMiddleOfTheBall) {
  const ByteImage grey(kWidth, kHeight, 3, 128);
  auto ball = disc_pixels({.x_px = 60, .y_px = 45, .contact_px = 6, .radius_px = 24}, grey, grey, {});
  for (ContactPixel& p : ball)
    p.target = p.x == 60 && p.y == 45 ? std::array{7.0, -5.0, 3.0} : std::array{50.0, 50.0, 50.0};
  const auto codes =
      fit_table({ball}, kWidth, kHeight, {.bins = 125}).change(0.0, 0.0, SlopeTable::terms(60, 45, kWidth, kHeight));
  EXPECT_NEAR(codes[0], 7.0, 1e-9);
  EXPECT_NEAR(codes[1], -5.0, 1e-9);
  EXPECT_NEAR(codes[2], 3.0, 1e-9);
}

TEST(FitTable, SlopesBeyondTheBallsHaveTheNearestWeights) {
  const SlopeTable table = fit_table(balls_of_known_light(), kWidth, kHeight,
                                     {.bins = 61, .pooled = true, .smoothing_bins = 1.0, .ridge = 0.01});
  const auto terms = SlopeTable::terms(60, 45, kWidth, kHeight);
  EXPECT_EQ(table.change(20.0, 0.0, terms), table.change(30.0, 0.0, terms));
  EXPECT_GT(table.change(20.0, 0.0, terms)[0], table.change(0.5, 0.0, terms)[0]);
}

TEST(FitTable, AFlatGelMayBeHeldAtZero) {
  TableFit settings{.bins = 61, .pooled = true, .smoothing_bins = 2.0, .ridge = 0.01};
  const auto terms = SlopeTable::terms(10, 80, kWidth, kHeight);
  auto balls = balls_of_known_light();
  for (auto& pixels : balls)
    for (ContactPixel& p : pixels) p.target[0] += 5.0;
  EXPECT_GT(fit_table(balls, kWidth, kHeight, settings).change(0.0, 0.0, terms)[0], 1.0);
  settings.flat_is_dark = true;
  EXPECT_EQ(fit_table(balls, kWidth, kHeight, settings).change(0.0, 0.0, terms)[0], 0.0);
}

TEST(FitTable, WithoutAPixelThereIsNone) {
  EXPECT_EQ(message_of<DataError>([] { fit_table({{}}, kWidth, kHeight, {.bins = 5, .pooled = true}); }),
            "no ball has a pixel in its contact that is not clipped");
  EXPECT_EQ(message_of<DataError>([] { fit_table({{}}, kWidth, kHeight, {.bins = 5}); }),
            "no ball has a pixel in its contact that is not clipped");
}

}  // namespace fit_table_test
}  // namespace tacipc
