#include "stages/study/metrics/measure.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/base/error.h"
#include "common/image/image.h"
#include "stages/study/metrics/ssim.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"
#include "tests/stages/study/metrics/test_images.h"

namespace tacipc {
namespace measure_images_test {

ImagePair pair_in(const ScratchFolder& folder, const ByteImage& a, const ByteImage& b) {
  write_png(folder / "a.png", a);
  write_png(folder / "b.png", b);
  return {"a.png", folder / "a.png", folder / "b.png"};
}

ImageMetrics config_of(const std::string& text) { return config_from_text<ImageMetrics>(text, "m.yaml"); }

TEST(Measure, CropIsTheSameAsComparingTheCutOutImages) {
  const ScratchFolder folder;
  const ByteImage a = pattern_image(60, 40), b = changed(a, "shift");
  const auto rows = measure_images({pair_in(folder, a, b)}, ImageMetrics{.crop_px = Box{5, 7, 31, 23}});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].region, "full");
  EXPECT_EQ(rows[1].region, "crop");
  ByteImage ca(31, 23, 3), cb(31, 23, 3);
  for (int y = 0; y < 23; ++y)
    for (int x = 0; x < 31; ++x)
      for (int c = 0; c < 3; ++c) ca.at(x, y, c) = a.at(x + 5, y + 7, c), cb.at(x, y, c) = b.at(x + 5, y + 7, c);
  EXPECT_EQ(rows[1]["ssim_w"], ssim(ca, cb, gaussian_window()));
  EXPECT_EQ(rows[1]["ssim_s"], ssim(ca, cb, box_window()));
  EXPECT_NE(rows[0]["ssim_w"], rows[1]["ssim_w"]);
  EXPECT_DOUBLE_EQ(rows[0]["psnr_ln"], rows[0]["psnr_db"] * std::log(10.0));
}

TEST(Measure, GreyImagesCompareLikeColoured) {
  const ScratchFolder folder;
  ByteImage a(16, 12, 1, 100), b(16, 12, 1, 110);
  const auto rows = measure_images({pair_in(folder, a, b)}, {});
  EXPECT_NEAR(rows[0]["ssim_w"], 0.9954764441, 1e-10);
  EXPECT_NEAR(rows[0]["mae"], 10.0 / 255, 1e-15);
}

TEST(Measure, SaysWhatDoesNotFit) {
  const ScratchFolder folder;
  const std::string a = (folder / "a.png").string(), b = (folder / "b.png").string();
  const auto said = [&](const ByteImage& x, const ByteImage& y, const ImageMetrics& config) {
    return message_of<DataError>([&] { measure_images({pair_in(folder, x, y)}, config); });
  };
  EXPECT_EQ(said(ByteImage(20, 12, 3), ByteImage(20, 13, 3), {}), a + " is 20 x 12 pixels, " + b + " is 20 x 13");
  EXPECT_EQ(said(ByteImage(20, 10, 3), ByteImage(20, 10, 3), {}), a + ": is 20 x 10 pixels, SSIM needs 11 each way");
  EXPECT_EQ(said(ByteImage(20, 20, 3), ByteImage(20, 20, 3), ImageMetrics{.crop_px = Box{9, 0, 12, 12}}),
            a + ": is 20 x 20 pixels, crop_px reaches to 21 x 12");
  folder.file("b.png", "broken");
  EXPECT_THAT(message_of<DataError>([&] {
                measure_images({{"a.png", folder / "a.png", folder / "b.png"}}, {});
              }),
              testing::StartsWith(b + ": "));
}

TEST(ImageMetrics, CropIsCheckedBeforeWork) {
  EXPECT_EQ(config_of("{crop_px: [1, 2, 30, 40]}").crop_px->height, 40);
  EXPECT_EQ(message_of<ConfigError>([] { config_of("{crop_px: [0, 0, 10, 40]}"); }),
            "m.yaml:1:11: crop_px: must be at least 11 pixels wide and high");
  EXPECT_EQ(message_of<ConfigError>([] { config_of("{crop_px: [0.5, 0, 20, 40]}"); }),
            "m.yaml:1:11: crop_px: expected whole pixels");
}

}  // namespace measure_images_test
}  // namespace tacipc
