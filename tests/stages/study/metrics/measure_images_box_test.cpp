// Metrics within a box, and the offset fitted outside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "stages/study/metrics/image_error.h"
#include "stages/study/metrics/measure.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"
#include "tests/stages/study/metrics/test_images.h"

namespace tacipc {
namespace measure_images_box_test {

TEST(SsimInBox, BoxesThatTileTheMapAverageToTheWhole) {
  const ByteImage a = pattern_image(41, 33), b = changed(a, "noise");
  for (const SsimWindow& window : {gaussian_window(), box_window()}) {
    const double left = ssim_in_box(a, b, window, {0, 0, 20, 33}), right = ssim_in_box(a, b, window, {20, 0, 21, 33});
    const int margin = window.size() / 2;
    const double share = (20.0 - margin) / (41.0 - 2 * margin);
    EXPECT_NEAR(share * left + (1.0 - share) * right, ssim(a, b, window), 1e-14);
    EXPECT_GT(std::abs(left - right), 1e-6);
  }
}

TEST(SsimInBox, OnePixelIsTheWindowAroundIt) {
  const ByteImage a = pattern_image(40, 30), b = changed(a, "fade");
  // The 7 × 7 images around (20, 15) have one window only.
  ByteImage small_a(7, 7, 3), small_b(7, 7, 3);
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 7; ++x)
      for (int c = 0; c < 3; ++c) {
        small_a.at(x, y, c) = a.at(17 + x, 12 + y, c);
        small_b.at(x, y, c) = b.at(17 + x, 12 + y, c);
      }
  EXPECT_NEAR(ssim_in_box(a, b, box_window(), {20, 15, 1, 1}), ssim(small_a, small_b, box_window()), 1e-14);
  EXPECT_TRUE(std::isnan(ssim_in_box(a, b, box_window(), {0, 0, 3, 3})));
}

TEST(Offset, IsTheMeanDifferenceOutsideTheBoxAlone) {
  ByteImage reference(10, 8, 3, 100), image(10, 8, 3, 100);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 10; ++x) {
      const bool inside = x >= 2 && x < 5 && y >= 1 && y < 4;
      image.at(x, y, 0) = inside ? 250 : 107;
      image.at(x, y, 1) = inside ? 3 : 95;
    }
  const ByteImage out = offset_to(image, reference, {2, 1, 3, 3});
  EXPECT_EQ(out.at(0, 0, 0), 100);
  EXPECT_EQ(out.at(3, 2, 0), 243);
  EXPECT_EQ(out.at(9, 7, 1), 100);
  EXPECT_EQ(out.at(3, 2, 1), 8);
  EXPECT_EQ(out.at(3, 2, 2), 100);
  reference.at(9, 7, 2) = 255;  // 155 over 71 pixels outside: an offset of 2.18
  EXPECT_EQ(offset_to(image, reference, {2, 1, 3, 3}).at(0, 0, 2), 102);
}

class BoxRows : public ::testing::Test {
 protected:
  std::vector<MetricsRow> rows(const std::string& config, const ByteImage& image, const ByteImage& reference) {
    write_png(scratch_ / "ball_1.png", image);
    write_png(scratch_ / "reference.png", reference);
    return measure_images({{"ball_1.png", scratch_ / "ball_1.png", scratch_ / "reference.png"}},
                          config_from_text<ImageMetrics>(config, "m.yaml"));
  }
  ScratchFolder scratch_;
};

TEST_F(BoxRows, ADriftOfTheWholePictureVanishes) {
  const ByteImage reference(40, 30, 3, 90);
  ByteImage image(40, 30, 3, 96);
  for (int x = 12; x < 20; ++x) image.at(x, 14, 1) = 116;
  const std::string boxes =
      "boxes: [{starts_with: coin, px: [0, 0, 9, 9]}, {starts_with: ball, px: [10, 10, 16, 8]}]\n";
  const auto plain = rows(boxes, image, reference),
             fitted = rows(boxes + "offset_outside_box: true\n", image, reference);
  ASSERT_EQ(fitted.size(), 2u);
  EXPECT_EQ(fitted[1].region, "box");
  EXPECT_NEAR(plain[1]["mae"], (6.0 + 20.0 * 8 / (3 * 16 * 8)) / 255.0, 1e-15);
  EXPECT_NEAR(fitted[1]["mae"], 20.0 * 8 / (3 * 16 * 8) / 255.0, 1e-15);
  EXPECT_NEAR(fitted[0]["mae"], 20.0 * 8 / (3 * 40 * 30) / 255.0, 1e-15);
  EXPECT_GT(fitted[1]["ssim_s"], plain[1]["ssim_s"]);
}

TEST_F(BoxRows, BoxesThatDoNotFitAreRefused) {
  const ByteImage grey(40, 30, 3, 90);
  const std::string image = (scratch_ / "ball_1.png").string();
  const auto refusal = [&](const std::string& config) {
    return message_of<DataError>([&] { rows(config, grey, grey); });
  };
  EXPECT_EQ(refusal("boxes: [{px: [30, 0, 11, 20]}]\n"), image + ": is 40 x 30 pixels, boxes reaches to 41 x 20");
  EXPECT_EQ(refusal("boxes: [{starts_with: coin, px: [3, 3, 11, 20]}]\n"),
            image + ": no box of the configuration begins as its name, ball_1.png");
  EXPECT_EQ(refusal("boxes: [{px: [0, 0, 5, 20]}]\n"),
            image + ": its box lies within 5 pixels of the border, where SSIM has no window");
  EXPECT_EQ(refusal("boxes: [{px: [0, 0, 40, 30]}]\noffset_outside_box: true\n"),
            image + ": its box is the whole image, so no offset can be fitted outside");
  EXPECT_THAT(faults_in<ImageMetrics>("offset_outside_box: true\nboxes: []\n", "m.yaml"),
              testing::ElementsAre("m.yaml:1:21: offset_outside_box: needs boxes"));
  EXPECT_THAT(faults_in<ImageMetrics>("boxes: [{px: [0, 0, 0, 3]}]\n", "m.yaml"),
              testing::ElementsAre("m.yaml:1:14: boxes[0].px: must be at least 1 pixel wide and high"));
}

}  // namespace measure_images_box_test
}  // namespace tacipc
