#include "common/image/image.h"

#include <gmock/gmock.h>

#include <random>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/shared_data.h"

namespace tacipc {
namespace image_test {

FloatImage gradient(int channels) {
  FloatImage image(7, 5, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.1f * static_cast<float>(i) - 2.0f;
  return image;
}

ByteImage pattern(int channels) {
  ByteImage image(9, 4, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(37 * i);
  return image;
}

TEST(Exr, ComesBackBitByBitWithItsChannelsInTheirOrder) {
  const ScratchFolder scratch;
  FloatImage normal = gradient(3);
  normal.at(3, 2, 1) = std::numeric_limits<float>::infinity();
  write_exr(scratch / "n.exr", normal, {"X", "Y", "Z"});
  EXPECT_EQ(read_exr(scratch / "n.exr", {"X", "Y", "Z"}).pixels, normal.pixels);
  const FloatImage z = read_exr(scratch / "n.exr", {"Z"});
  EXPECT_EQ(z.channels, 1);
  EXPECT_EQ(z.at(4, 3, 0), normal.at(4, 3, 2));
  // "R" sorts after "B" in the file.
  write_exr(scratch / "c.exr", gradient(3), {"R", "G", "B"});
  EXPECT_EQ(read_exr(scratch / "c.exr", {"R", "G", "B"}).pixels, gradient(3).pixels);
  const std::string first = read_file(scratch / "c.exr");
  write_exr(scratch / "c.exr", gradient(3), {"R", "G", "B"});
  EXPECT_EQ(read_file(scratch / "c.exr"), first);
}

TEST(Exr, HalvesKeepElevenDigitsAndAreSmaller) {
  const ScratchFolder scratch;
  FloatImage image = gradient(3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 1.0f / (1.0f + static_cast<float>(i));
  image.at(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  image.at(1, 0, 0) = -65504.0f;
  write_exr(scratch / "h.exr", image, {"X", "Y", "Z"}, ExrNumbers::halves);
  const FloatImage back = read_exr(scratch / "h.exr", {"X", "Y", "Z"});
  EXPECT_TRUE(std::isnan(back.pixels[0]));
  for (std::size_t i = 1; i < image.pixels.size(); ++i)
    EXPECT_NEAR(back.pixels[i] / image.pixels[i], 1.0, 0.00049) << i;
  image.at(2, 0, 0) = 70000.0f;
  EXPECT_EQ(message_of<DataError>([&] {
              write_exr(scratch / "h.exr", image, {"X", "Y", "Z"}, ExrNumbers::halves);
            }),
            (scratch / "h.exr").string() + ": 70000 is too large for a half float");
}

TEST(Exr, FaultsAreNamed) {
  const ScratchFolder scratch;
  write_exr(scratch / "d.exr", gradient(1), {"Z"});
  const std::string name = (scratch / "d.exr").string();
  EXPECT_EQ(message_of<DataError>([&] { read_exr(name, {"R"}); }), name + ": has no channel 'R' (it has: Z)");
  EXPECT_EQ(message_of<DataError>([&] { write_exr("/dev/full", gradient(1), {"Z"}); }),
            "/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(message_of<DataError>([&] { write_exr(name, gradient(3), {"Z"}); }),
            name + ": 1 channel names for 3 channels");
  EXPECT_EQ(message_of<DataError>([&] { write_exr(name, FloatImage(), {}); }),
            name + ": an image of 0 x 0 pixels is not written");
  EXPECT_THAT(message_of<DataError>([&] { read_exr(scratch.file("no.exr", "no image"), {"Z"}); }),
              ::testing::HasSubstr("no.exr: is not a readable EXR image: "));
}

TEST(Png, ComesBackAsRgbOrGreyAndItsBytesAreFixed) {
  const ScratchFolder scratch;
  for (const int channels : {1, 3}) {
    const ByteImage image = pattern(channels);
    write_png(scratch / "a.png", image);
    const ByteImage back = read_png(scratch / "a.png", channels);
    EXPECT_EQ(back.width, 9);
    EXPECT_EQ(back.pixels, image.pixels);
    const std::string first = read_file(scratch / "a.png");
    write_png(scratch / "a.png", image);
    EXPECT_EQ(read_file(scratch / "a.png"), first);
  }
  ByteImage red(2, 2, 3);
  red.at(0, 0, 0) = 255;
  write_png(scratch / "red.png", red);
  EXPECT_EQ(read_png(scratch / "red.png", 1).at(0, 0, 0), 76) << "0.299 of red";
}

TEST(Png, NoiseIsNotSearchedForStringsButDrawingsAre) {
  const ScratchFolder scratch;
  ByteImage noisy(320, 240, 3), flat(320, 240, 3);
  std::mt19937 random(1);
  for (std::size_t i = 0; i < noisy.pixels.size(); ++i)
    noisy.pixels[i] = static_cast<std::uint8_t>(100 + i / 5000 + random() % 8);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) flat.at(x, y, 1) = (x / 40 + y / 40) % 2 ? 255 : 20;
  for (const ByteImage& image : {noisy, flat}) {
    write_png(scratch / "a.png", image);
    EXPECT_EQ(read_png(scratch / "a.png", 3).pixels, image.pixels);
  }
  // Eight values are 3 bits, their differences from the mean of two neighbours 3.6, from one of them 3.8.
  EXPECT_LT(png_bytes(noisy, "noisy").size(), noisy.pixels.size() * 37 / 80);
  EXPECT_LT(png_bytes(flat, "flat").size(), 2000u);
}

TEST(Png, FaultsAreNamed) {
  const ScratchFolder scratch;
  write_png(scratch / "a.png", pattern(3));
  const std::string bytes = read_file(scratch / "a.png");
  const std::string name = (scratch / "b.png").string();
  const auto error = [&](const std::string& content) {
    return message_of<DataError>([&] { read_png(scratch.file("b.png", content), 3); });
  };
  EXPECT_EQ(error(""), name + ": is not a readable image (PNG or JPEG)");
  EXPECT_EQ(error("GIF nothing"), name + ": is not a readable image (PNG or JPEG)");
  EXPECT_EQ(error(bytes.substr(0, bytes.size() - 1)),
            name + ": the file ends inside a chunk at byte " + std::to_string(bytes.size() - 4));
  std::string flipped = bytes;
  flipped[45] = static_cast<char>(flipped[45] ^ 1);
  EXPECT_THAT(error(flipped), ::testing::HasSubstr(": a chunk has the wrong checksum at byte "));
  EXPECT_EQ(message_of<DataError>([&] { write_png("/dev/full", pattern(1)); }),
            "/dev/full: cannot be written: No space left on device");
  EXPECT_EQ(message_of<DataError>([&] { write_png(name, pattern(2)); }),
            name + ": an image of 9 x 4 pixels and 2 channels is not written (1 or 3 channels are)");
}

TEST(Jpeg, IsAlmostThePictureInFewerBytes) {
  const ScratchFolder scratch;
  ByteImage image(64, 48, 3);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      image.at(x, y, 0) = static_cast<std::uint8_t>(2 * x);
      image.at(x, y, 1) = static_cast<std::uint8_t>(3 * y);
      image.at(x, y, 2) = 200;
    }
  }
  const std::string bytes = jpeg_bytes(image, 90, "a.jpg");
  EXPECT_EQ(bytes, jpeg_bytes(image, 90, "a.jpg"));
  EXPECT_LT(jpeg_bytes(image, 40, "a.jpg").size(), bytes.size());
  const ByteImage back = read_png(scratch.file("a.jpg", bytes), 3);
  ASSERT_EQ(back.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < back.pixels.size(); ++i) EXPECT_NEAR(back.pixels[i], image.pixels[i], 8) << i;
  EXPECT_EQ(message_of<DataError>([&] { jpeg_bytes(pattern(1), 90, "a.jpg"); }),
            "a.jpg: an image of 9 x 4 pixels and 1 channels is not written (3 channels are)");
}

TEST(Png, RealPhotographIsRead) {
  TACIPC_SHARED_DATA(photo, "data/gelsight_sim2real/images/background_real.png");
  const ByteImage image = read_png(photo, 3);
  EXPECT_EQ(image.width, 320);
  EXPECT_EQ(image.height, 320);
}

}  // namespace image_test
}  // namespace tacipc
