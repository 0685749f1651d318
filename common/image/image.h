// Images in memory, and their files: EXR (float), PNG and JPEG (8 bit).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// Row-major pixels, channels interleaved, row 0 on top.
template <typename T>
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<T> pixels;

  Image() = default;
  Image(int w, int h, int c, T value = T{})
      : width(w), height(h), channels(c), pixels(static_cast<std::size_t>(w) * h * c, value) {}
  T& at(int x, int y, int c) { return pixels[(static_cast<std::size_t>(y) * width + x) * channels + c]; }
  const T& at(int x, int y, int c) const { return const_cast<Image*>(this)->at(x, y, c); }
};
using FloatImage = Image<float>;
using ByteImage = Image<std::uint8_t>;

/// How an EXR stores a number: in 32 bits, or in 16 (11 digits of two; nothing above 65,504, steps of 6e-8 near 0).
enum class ExrNumbers { floats, halves };

/// EXR, compressed without loss (ZIP). Channel names by count: 1 `names[0]`, 3 the given three (for instance R G B, or
/// X Y Z). \throw DataError if it cannot be written, or a number is too large for a half
void write_exr(const std::filesystem::path& path, const FloatImage& image,
               const std::vector<std::string>& channel_names, ExrNumbers numbers = ExrNumbers::floats);
/// Reads the named channels. \throw DataError if the file is not an EXR or lacks one, naming what it has.
FloatImage read_exr(const std::filesystem::path& path, const std::vector<std::string>& channel_names);

/// 8-bit PNG, 1 (grey) or 3 (RGB) channels; the bytes depend on nothing but the pixels.
void write_png(const std::filesystem::path& path, const ByteImage& image);
/// The same as bytes; `name` stands for the file in messages.
std::string png_bytes(const ByteImage& image, const std::string& name);
/// 8-bit JPEG of 3 channels (RGB) as bytes, quality 1 … 100: for people, not for data. `name` as in png_bytes.
std::string jpeg_bytes(const ByteImage& image, int quality, const std::string& name);
/// As RGB (channels = 3) or grey (channels = 1), 8 bit. \throw DataError if it is not a readable image.
ByteImage read_png(const std::filesystem::path& path, int channels);

}  // namespace tacipc
