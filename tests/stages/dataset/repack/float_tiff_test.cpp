#include "stages/dataset/repack/float_tiff.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <vector>

namespace tacipc {
namespace float_tiff_test {

template <typename T>
T at(const std::string& bytes, std::size_t position) {
  T value;
  std::memcpy(&value, bytes.data() + position, sizeof(value));
  return value;
}

TEST(FloatTiff, ComesBackBitByBit) {
  const std::vector<float> pixels{0.0F, -0.0F, 1.5F, 1e-38F, -3.25e7F, std::numeric_limits<float>::quiet_NaN()};
  const std::string file = float_tiff_bytes(pixels, 3, 2);
  ASSERT_EQ(file.substr(0, 2), "II");
  EXPECT_EQ(at<std::uint16_t>(file, 2), 42);
  const auto directory = at<std::uint32_t>(file, 4);
  EXPECT_EQ(directory % 2, 0U);
  std::uint32_t begin = 0, size = 0;
  for (std::uint16_t i = 0, previous = 0; i < at<std::uint16_t>(file, directory); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    const auto tag = at<std::uint16_t>(file, entry);
    EXPECT_GT(tag, previous) << "tags must ascend";
    previous = tag;
    if (tag == 256 || tag == 257) {
      EXPECT_EQ(at<std::uint32_t>(file, entry + 8), tag == 256 ? 3U : 2U);
    }
    if (tag == 273) begin = at<std::uint32_t>(file, entry + 8);
    if (tag == 279) size = at<std::uint32_t>(file, entry + 8);
  }
  std::string planes(pixels.size() * sizeof(float), '\0');
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  ASSERT_EQ(
      libdeflate_zlib_decompress(decompressor.get(), file.data() + begin, size, planes.data(), planes.size(), nullptr),
      LIBDEFLATE_SUCCESS);
  for (std::size_t y = 0; y < 2; ++y) {
    std::string row = planes.substr(12 * y, 12);
    for (std::size_t i = 1; i < row.size(); ++i) row[i] = static_cast<char>(row[i] + row[i - 1]);
    for (std::size_t x = 0; x < 3; ++x) {
      const std::string bytes{row[9 + x], row[6 + x], row[3 + x], row[x]};
      EXPECT_EQ(at<std::uint32_t>(bytes, 0), std::bit_cast<std::uint32_t>(pixels[3 * y + x])) << x << ", " << y;
    }
  }
}

}  // namespace float_tiff_test
}  // namespace tacipc
