// Numbers of an image: which of them change with what.
#include "common/benchmark/image_look.h"

#include <gtest/gtest.h>

#include "common/image/picture.h"
#include "tests/common/benchmark/shaded_dents.h"

namespace tacipc {
namespace image_look_test {

TEST(ReducedImage, IsMeansOverSquaresAndWhatIsLeftOfThem) {
  ByteImage image(5, 3, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 5; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<std::uint8_t>(10 * x + 3 * y + c);
  const FloatImage small = means_over_squares(image, 2);
  ASSERT_EQ(small.width, 3);
  ASSERT_EQ(small.height, 2);
  EXPECT_FLOAT_EQ(small.at(0, 0, 0), (0 + 10 + 3 + 13) / 4.0F);
  EXPECT_FLOAT_EQ(small.at(2, 0, 1), (41 + 44) / 2.0F);
  EXPECT_FLOAT_EQ(small.at(1, 1, 2), (28 + 38) / 2.0F);
  EXPECT_FLOAT_EQ(small.at(2, 1, 0), 46.0F);
  EXPECT_EQ(means_over_squares(image, 1).pixels, std::vector<float>(image.pixels.begin(), image.pixels.end()));
}

TEST(TurnedImage, MovesPixelsAndChannels) {
  FloatImage image(3, 2, 3);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 3; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(100 * c + 10 * y + x);
  EXPECT_EQ(turned(image, {.swapped = true}).at(1, 1, 0), 211.0F);
  EXPECT_EQ(turned(image, {.left_right = true}).at(0, 1, 1), 112.0F);
  EXPECT_EQ(turned(image, {.top_bottom = true}).at(0, 1, 1), 100.0F);
  const FloatImage quarter = turned(image, {.transposed = true, .left_right = true});  // clockwise
  ASSERT_EQ(quarter.width, 2);
  EXPECT_EQ(quarter.at(1, 0, 0), image.at(0, 0, 0));
  EXPECT_EQ(quarter.at(0, 0, 0), image.at(0, 1, 0));
  EXPECT_EQ(quarter.at(1, 2, 0), image.at(2, 0, 0));
  for (const ImageTurn& turn : {ImageTurn{.swapped = true, .left_right = true, .top_bottom = true},
                                ImageTurn{.top_bottom = true}, ImageTurn{.transposed = true}})
    EXPECT_EQ(turned(turned(image, turn), turn).pixels, image.pixels);
}

TEST(ImageLook, OfABackgroundIsItsPatternAndWhatIsNoPlane) {
  FloatImage plane(96, 72, 3);
  for (int y = 0; y < 72; ++y)
    for (int x = 0; x < 96; ++x)
      for (int c = 0; c < 3; ++c) plane.at(x, y, c) = static_cast<float>(50.0 + 0.5 * x - 0.25 * y + 10.0 * c);
  const ImageLook smooth = look_of(plane, plane);
  for (std::size_t part = 0; part < kLookParts.size(); ++part) EXPECT_EQ(smooth.parts[part].size(), kLookSizes[part]);
  // The first cell's middle is (5.5, 5.5); in units of 2 codes.
  EXPECT_NEAR(smooth[LookPart::pattern][0], (50.0 + 0.25 * 5.5) / 2.0, 1e-5);
  EXPECT_NEAR(smooth[LookPart::pattern][48], (60.0 + 0.25 * 5.5) / 2.0, 1e-5);
  EXPECT_LT(smooth[LookPart::relief].cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_EQ(smooth[LookPart::level].cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(smooth[LookPart::shading].cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(smooth.change_codes, 0.0);
  FloatImage edge = plane;  // a line of a cell
  for (int y = 0; y < 12; ++y) edge.at(40, y, 0) += 30.0F;
  const Eigen::VectorXd rough = roughness_of(look_of(edge, edge)[LookPart::relief]);
  Eigen::Index roughest = 0;
  EXPECT_GT(rough.maxCoeff(&roughest), 2.0);
  EXPECT_EQ(roughest, 3);
  EXPECT_LT((rough.array().abs() > 1e-3).count(), 2);
}

TEST(ImageLook, OfAChangeTurnsWithItAndNotWithItsPlace) {
  const auto shading = [](const ByteImage& image, const ByteImage& background) {
    return look_of(means_over_squares(background, 1), means_over_squares(image, 1))[LookPart::shading];
  };
  const MadeUpLamps lamps;
  for (const std::size_t dent : {0, 1, 2}) {
    const ByteImage image = shaded_image(lamps, dent, true), background = shaded_image(lamps, dent, false);
    const Eigen::VectorXd now = shading(image, background);
    const auto other = [&](const ImageTurn& turn) {
      return look_of(turned(means_over_squares(background, 1), turn),
                     turned(means_over_squares(image, 1), turn))[LookPart::shading];
    };
    const Eigen::VectorXd about = other({.left_right = true, .top_bottom = true}), swapped = other({.swapped = true});
    EXPECT_LT((about.head<6>() + now.head<6>()).norm(), 1e-6);
    EXPECT_LT((about.tail<7>() - now.tail<7>()).norm(), 1e-6);
    EXPECT_LT((swapped.head<2>() - now.segment<2>(4)).norm(), 1e-6);
    // Red gets lighter away from its lamp, which is at 10 degrees; the unit is a tenth.
    EXPECT_GT(std::abs(now[0]), 4.0);
    EXPECT_LT(std::abs(now[1]), 3.0);
    const Eigen::VectorXd elsewhere =
        shading(shaded_image(lamps, dent + 3, true), shaded_image(lamps, dent + 3, false));
    EXPECT_LT((elsewhere.head<6>() - now.head<6>()).cwiseAbs().maxCoeff(), 3.0);
    EXPECT_EQ(now[0] > 0.0, elsewhere[0] > 0.0);
  }
}

TEST(ImageLook, OfAnUntouchedPartIsItsLevel) {
  const MadeUpLamps lamps;
  const FloatImage background = means_over_squares(shaded_image(lamps, 1, false), 1);
  FloatImage brighter = means_over_squares(shaded_image(lamps, 1, true), 1);
  for (std::size_t i = 0; i < brighter.pixels.size(); i += 3) brighter.pixels[i] += 6.0F;
  const Eigen::VectorXd level = look_of(background, brighter)[LookPart::level];
  EXPECT_NEAR(level[1], 4.0, 0.3);  // the middle of red, 6 codes
  EXPECT_NEAR(level[4], 0.0, 0.3);
}

}  // namespace image_look_test
}  // namespace tacipc
