#include <algorithm>
#include <array>
#include <bit>
#include <opencv2/imgcodecs.hpp>

#include "common/byte_reader.h"
#include "common/error.h"
#include "common/files.h"
#include "common/image.h"

namespace tacipc {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
/// Deflate cannot shrink further.
constexpr std::uint64_t kLargestRatio = 1040;
constexpr int kCompression = 6;

/// CRC-32 as PNG defines it (polynomial 0xedb88320, reflected).
std::uint32_t crc32(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1u) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
      t[n] = c;
    }
    return t;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes) crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xffu] ^ (crc >> 8);
  return ~crc;
}

/// The decoder prints its complaints and returns grey rows for missing data, so faults are looked for before it runs.
void check_png(const std::string& bytes, const std::string& name) {
  ByteReader in(bytes, name, std::endian::big);
  in.skip(kSignature.size(), "the signature");
  for (bool ended = false, first = true; !ended; first = false) {
    const auto length = in.read<std::uint32_t>("a chunk");
    const std::size_t begin = in.at();
    in.skip(std::size_t{4} + length, "a chunk");
    const std::string_view chunk = std::string_view(bytes).substr(begin, std::size_t{4} + length);
    if (in.read<std::uint32_t>("a chunk") != crc32(chunk)) in.fail("a chunk has the wrong checksum");
    if (first && (!chunk.starts_with("IHDR") || length != 13)) in.fail("the PNG header is missing");
    if (first) {
      ByteReader header(chunk, name, std::endian::big);
      header.skip(4, "the header");
      const std::uint64_t width = header.read<std::uint32_t>("the header");
      const std::uint64_t height = header.read<std::uint32_t>("the header");
      const std::uint64_t bits = header.read<std::uint8_t>("the header");
      if (width == 0 || height == 0 || (width * height / 8 + 1) * bits / kLargestRatio > bytes.size())
        throw DataError("{}: {} x {} pixels cannot be in a file of {} bytes", name, width, height, bytes.size());
    }
    ended = chunk.starts_with("IEND");
  }
}

/// Rows as OpenCV wants them: colours from blue to red.
cv::Mat opencv_pixels(const ByteImage& image) {
  cv::Mat pixels(image.height, image.width, image.channels == 1 ? CV_8UC1 : CV_8UC3);
  const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* source = image.pixels.data() + row * static_cast<std::size_t>(y);
    std::uint8_t* target = pixels.ptr<std::uint8_t>(y);
    std::copy(source, source + row, target);
    for (std::size_t i = 0; image.channels == 3 && i < row; i += 3) std::swap(target[i], target[i + 2]);
  }
  return pixels;
}

/// The image in a format that knows colours, and grey where `grey` is set.
std::string encoded(const ByteImage& image, const std::string& name, const std::string& format, bool grey,
                    const std::vector<int>& settings) {
  if (image.width < 1 || image.height < 1 || (image.channels != 3 && !(grey && image.channels == 1)))
    throw DataError("{}: an image of {} x {} pixels and {} channels is not written ({} channels are)", name,
                    image.width, image.height, image.channels, grey ? "1 or 3" : "3");
  std::vector<std::uint8_t> bytes;
  try {
    if (!cv::imencode("." + format, opencv_pixels(image), bytes, settings))
      throw DataError("{}: cannot be written as {}", name, format);
  } catch (const cv::Exception& error) {
    throw DataError("{}: cannot be written as {}: {}", name, format, error.what());
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string png_bytes(const ByteImage& image, const std::string& name) {
  return encoded(image, name, "png", true, {cv::IMWRITE_PNG_COMPRESSION, kCompression});
}

std::string jpeg_bytes(const ByteImage& image, int quality, const std::string& name) {
  return encoded(image, name, "jpg", false, {cv::IMWRITE_JPEG_QUALITY, quality});
}

void write_png(const std::filesystem::path& path, const ByteImage& image) {
  write_file(path, png_bytes(image, path.string()));
}

ByteImage read_png(const std::filesystem::path& path, int channels) {
  const std::string name = path.string();
  if (channels != 1 && channels != 3) throw DataError("{}: {} channels asked for, 1 or 3 can be had", name, channels);
  const std::string bytes = read_file(path);
  if (bytes.starts_with(kSignature)) check_png(bytes, name);
  cv::Mat pixels;
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    if (!bytes.empty())
      pixels =
          cv::imdecode(raw, (channels == 1 ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR) | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& error) {
    throw DataError("{}: is no readable image: {}", name, error.what());
  }
  if (pixels.empty()) throw DataError("{}: is no readable image", name);
  ByteImage image(pixels.cols, pixels.rows, channels);
  const std::size_t row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(channels);
  for (int y = 0; y < image.height; ++y) {
    const std::uint8_t* source = pixels.ptr<std::uint8_t>(y);
    std::uint8_t* target = image.pixels.data() + row * static_cast<std::size_t>(y);
    std::copy(source, source + row, target);
    for (std::size_t i = 0; channels == 3 && i < row; i += 3) std::swap(target[i], target[i + 2]);
  }
  return image;
}

}  // namespace tacipc
