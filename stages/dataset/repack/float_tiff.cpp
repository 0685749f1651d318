#include "stages/dataset/repack/float_tiff.h"

#include <libdeflate.h>

#include <bit>
#include <cassert>
#include <cstdint>
#include <memory>
#include <vector>

namespace tacipc {
namespace {

static_assert(std::endian::native == std::endian::little);

/// Each row as its bytes of highest order, then the next order, and so on; each byte as the difference from the
/// previous.
std::string predicted(std::span<const float> pixels, int width, int height) {
  constexpr std::size_t kBytes = sizeof(float);
  const auto columns = static_cast<std::size_t>(width);
  std::string bytes(pixels.size_bytes(), '\0');
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    char* row = bytes.data() + y * columns * kBytes;
    for (std::size_t x = 0; x < columns; ++x) {
      const auto bits = std::bit_cast<std::uint32_t>(pixels[y * columns + x]);
      for (std::size_t b = 0; b < kBytes; ++b) row[b * columns + x] = static_cast<char>(bits >> (8 * (kBytes - 1 - b)));
    }
    for (std::size_t i = columns * kBytes - 1; i > 0; --i) row[i] = static_cast<char>(row[i] - row[i - 1]);
  }
  return bytes;
}

std::string deflated(const std::string& bytes) {
  constexpr int kLevel = 6;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kLevel), libdeflate_free_compressor);
  std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  packed.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  return packed;
}

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

}  // namespace

std::string float_tiff_bytes(std::span<const float> pixels, int width, int height) {
  assert(pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const std::string strip = deflated(predicted(pixels, width, height));
  constexpr std::uint32_t kHeader = 8;
  constexpr std::uint16_t kShort = 3, kLong = 4;
  struct Tag {
    std::uint16_t tag, type;
    std::uint32_t value;
  };
  const auto size = static_cast<std::uint32_t>(strip.size());
  const std::vector<Tag> tags{{256, kLong, static_cast<std::uint32_t>(width)},
                              {257, kLong, static_cast<std::uint32_t>(height)},
                              {258, kShort, 32},                                 // bits per number
                              {259, kShort, 8},                                  // deflate
                              {262, kShort, 1},                                  // 0 is black
                              {273, kLong, kHeader},                             // offset of the strip
                              {277, kShort, 1},                                  // numbers per pixel
                              {278, kLong, static_cast<std::uint32_t>(height)},  // rows per strip
                              {279, kLong, size},
                              {317, kShort, 3},   // floating-point predictor
                              {339, kShort, 3}};  // IEEE numbers
  std::string bytes = "II";
  append<std::uint16_t>(bytes, 42);
  const std::uint32_t directory = kHeader + size + size % 2;  // even offset
  append(bytes, directory);
  bytes += strip;
  bytes.resize(directory, '\0');
  append(bytes, static_cast<std::uint16_t>(tags.size()));
  for (const Tag& tag : tags) {
    append(bytes, tag.tag);
    append(bytes, tag.type);
    append<std::uint32_t>(bytes, 1);
    append(bytes, tag.value);  // for shorts only the first two bytes count
  }
  append<std::uint32_t>(bytes, 0);
  return bytes;
}

}  // namespace tacipc
