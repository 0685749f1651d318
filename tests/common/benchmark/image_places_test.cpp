#include "common/benchmark/image_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/config_text.h"

namespace tacipc {
namespace image_places_test {

TEST(ImagePlaces, FaultsAreSaid) {
  EXPECT_THAT(
      faults_in<ImagePlaces>("images: [{name: a, frame: 1}, {name: a, frame: 2}]\nplace: {center_px: [1, 2]}\n"
                             "fit: {image: b, box_px: [0, 0, 1.5, 2], yaw: true}\n",
                             "s.yaml"),
      testing::ElementsAre(testing::HasSubstr("images[1].name: is given twice"),
                           testing::HasSubstr("fit.image: is not one of the images"),
                           testing::HasSubstr("fit.box_px: expected whole pixels, at least one wide and high")));
}

/// A bright cross about a place, over 60 × 50 pixels.
ByteImage cross_at(const ImagePlace& place) {
  ByteImage image(60, 50, 3, 100);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x) {
      const double dx = x - place.x_px, dy = y - place.y_px, c = std::cos(place.yaw_rad), s = std::sin(place.yaw_rad);
      const double u = c * dx + s * dy, v = c * dy - s * dx;
      const double arm = std::exp(-0.02 * u * u - 0.2 * v * v) + 0.5 * std::exp(-0.2 * u * u - 0.02 * v * v);
      for (int k = 0; k < 3; ++k) image.at(x, y, k) = static_cast<std::uint8_t>(100.0 + 80.0 * arm);
    }
  return image;
}

TEST(SearchPlace, FindsAPictureWhereItIsWhateverItsBrightness) {
  const ImagePlace truth{.x_px = 31.4, .y_px = 22.7, .yaw_rad = 5.0 * std::numbers::pi / 180.0};
  ByteImage photograph = cross_at(truth);
  for (std::uint8_t& code : photograph.pixels) code = static_cast<std::uint8_t>(code + 9);  // drifted
  const PlaceFit fit{.image = "a", .box_px = {12, 6, 38, 36}, .yaw = true};
  const FittedPlace found = search_place({.x_px = 29, .y_px = 25, .yaw_rad = 0}, fit, photograph, cross_at);
  EXPECT_NEAR(found.place.x_px, truth.x_px, 0.05);
  EXPECT_NEAR(found.place.y_px, truth.y_px, 0.05);
  EXPECT_NEAR(found.place.yaw_rad, truth.yaw_rad, 0.002);
  EXPECT_LT(found.rmse_after, 0.6);
  EXPECT_GT(found.rmse_before, 10.0);
  PlaceFit straight = fit;
  straight.yaw = false;
  EXPECT_EQ(search_place({.x_px = 29, .y_px = 25, .yaw_rad = 0}, straight, photograph, cross_at).place.yaw_rad, 0.0);
}

}  // namespace image_places_test
}  // namespace tacipc
