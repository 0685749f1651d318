// Images in memory, and their files: EXR (float), PNG and JPEG (8 bit).
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

/// Row-major pixels, channels interleaved, row 0 at the top.
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

/// Storage of an EXR's numbers: 32 bits, or 16 (11 binary digits; at most 65,504; steps of 6e-8 near 0).
enum class ExrNumbers { floats, halves };

/// Writes an EXR with lossless compression (ZIP).
/// \param channel_names for one channel `names[0]`, for three the given names (for instance R G B, or X Y Z)
/// \throw DataError if the file cannot be written, or a number is too large for a half
void write_exr(const std::filesystem::path& path, const FloatImage& image,
               const std::vector<std::string>& channel_names, ExrNumbers numbers = ExrNumbers::floats);
/// Reads the named channels.
/// \throw DataError if the file is not an EXR or lacks a channel; the message lists the channels there are
FloatImage read_exr(const std::filesystem::path& path, const std::vector<std::string>& channel_names);

/// Writes an 8-bit PNG of 1 (grey) or 3 (RGB) channels; the bytes depend on the pixels alone.
void write_png(const std::filesystem::path& path, const ByteImage& image);
/// Returns the PNG as bytes; `name` stands for the file in messages.
std::string png_bytes(const ByteImage& image, const std::string& name);
/// Returns an 8-bit RGB JPEG as bytes, quality 1 … 100. For viewing, not for data. `name` as in png_bytes().
std::string jpeg_bytes(const ByteImage& image, int quality, const std::string& name);
/// Reads a PNG or JPEG as 8-bit RGB (channels = 3) or grey (channels = 1).
/// \throw DataError if it is not a readable image
ByteImage read_png(const std::filesystem::path& path, int channels);

}  // namespace tacipc
