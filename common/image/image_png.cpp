#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <csetjmp>

#include "common/base/byte_reader.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/image/image.h"
#include "common/image/image_jpeg.h"

namespace tacipc {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
/// Largest compression ratio of deflate.
constexpr std::uint64_t kLargestRatio = 1040;
constexpr int kCompression = 6, kCompressionOfNoise = 1;

/// Returns the CRC-32, which PNG and zlib share.
std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Checks the file's chunks and reports the location of an error, which libpng would not.
void check_png(const std::string& bytes, const std::string& name) {
  ByteReader in(bytes, name, std::endian::big);
  in.skip(kSignature.size(), "the signature");
  for (bool ended = false, first = true; !ended; first = false) {
    const auto length = in.read<std::uint32_t>("a chunk");
    const std::size_t begin = in.at();
    in.skip(std::size_t{4} + length, "a chunk");
    const std::string_view chunk = std::string_view(bytes).substr(begin, std::size_t{4} + length);
    if (in.read<std::uint32_t>("a chunk") != checksum(chunk)) in.fail("a chunk has the wrong checksum");
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

/// Messages of libpng for a file, and the bytes that are read or written. libpng leaves a function by longjmp, which
/// must not skip destructors: the functions that call it hold plain values only.
struct PngFile {
  std::string_view in;
  std::string out;
  std::string fault;
};

void note_fault(png_structp png, png_const_charp text) {
  static_cast<PngFile*>(png_get_error_ptr(png))->fault = text;
  png_longjmp(png, 1);
}

void pass_over(png_structp, png_const_charp) {}

void take_bytes(png_structp png, png_bytep target, std::size_t count) {
  auto& file = *static_cast<PngFile*>(png_get_io_ptr(png));
  if (file.in.size() < count) png_error(png, "the file ends early");
  std::copy_n(file.in.data(), count, target);
  file.in.remove_prefix(count);
}

void give_bytes(png_structp png, png_bytep source, std::size_t count) {
  static_cast<PngFile*>(png_get_io_ptr(png))->out.append(reinterpret_cast<const char*>(source), count);
}

/// Returns whether most pixels differ from the previous one: a photograph, or an image with a camera's noise. For
/// these, a search for repeated strings is not worth its time: run-length coding of differences takes a tenth of it and
/// makes files even 6 % smaller. Differences from the mean of two neighbours contain less noise than from one: another
/// 2 to 5 %.
bool is_noisy(const ByteImage& image) {
  const auto channels = static_cast<std::size_t>(image.channels), count = image.pixels.size() / channels;
  std::size_t same = 0;
  const std::uint8_t* pixel = image.pixels.data();
  for (std::size_t i = 1; i < count; ++i) {
    unsigned differs = 0;
    for (std::size_t c = 0; c < channels; ++c, ++pixel) differs |= pixel[0] ^ pixel[channels];
    same += differs == 0 ? 1U : 0U;
  }
  return 2 * same < count;
}

/// Encodes an image.
/// \return false if libpng failed
bool encode(PngFile& file, const ByteImage& image) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &file, note_fault, pass_over);
  png_infop info = png_create_info_struct(png);
  if (setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &file, give_bytes, nullptr);
  const bool noisy = is_noisy(image);
  png_set_compression_level(png, noisy ? kCompressionOfNoise : kCompression);
  png_set_compression_strategy(png, noisy ? Z_RLE : Z_DEFAULT_STRATEGY);
  if (noisy) png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_AVG);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
               image.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  for (std::size_t at = 0; at < image.pixels.size(); at += row) png_write_row(png, image.pixels.data() + at);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return true;
}

/// Decodes to `image.channels` channels, 8 bit, without transparency.
/// \return false if libpng failed
bool decode(PngFile& file, ByteImage& image) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &file, note_fault, pass_over);
  png_infop info = png_create_info_struct(png);
  if (setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &file, take_bytes);
  png_read_info(png, info);
  png_set_strip_16(png);
  png_set_strip_alpha(png);
  const int kind = png_get_color_type(png, info);
  if (kind == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
  if ((kind & PNG_COLOR_MASK_COLOR) == 0) png_set_expand_gray_1_2_4_to_8(png);
  if (image.channels == 3)
    png_set_gray_to_rgb(png);
  else
    png_set_rgb_to_gray(png, PNG_ERROR_ACTION_NONE, 0.299, 0.587);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  image = ByteImage(static_cast<int>(png_get_image_width(png, info)), static_cast<int>(png_get_image_height(png, info)),
                    image.channels);
  const std::size_t row = static_cast<std::size_t>(image.width) * image.channels;
  if (png_get_rowbytes(png, info) != row) png_error(png, "its pixels are of an unknown kind");
  for (int pass = 0, passes = png_set_interlace_handling(png); pass < passes; ++pass) {
    for (std::size_t at = 0; at < image.pixels.size(); at += row) png_read_row(png, image.pixels.data() + at, nullptr);
  }
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

std::string png_bytes(const ByteImage& image, const std::string& name) {
  if (image.width < 1 || image.height < 1 || (image.channels != 1 && image.channels != 3))
    throw DataError("{}: an image of {} x {} pixels and {} channels is not written (1 or 3 channels are)", name,
                    image.width, image.height, image.channels);
  PngFile file;
  if (!encode(file, image)) throw DataError("{}: cannot be written as PNG: {}", name, file.fault);
  return file.out;
}

void write_png(const std::filesystem::path& path, const ByteImage& image) {
  write_file(path, png_bytes(image, path.string()));
}

ByteImage read_png(const std::filesystem::path& path, int channels) {
  const std::string name = path.string();
  if (channels != 1 && channels != 3)
    throw DataError("{}: {} channels requested, 1 or 3 are supported", name, channels);
  const std::string bytes = read_file(path);
  if (is_jpeg(bytes)) return decode_jpeg(bytes, channels, name);
  if (!bytes.starts_with(kSignature)) throw DataError("{}: is not a readable image (PNG or JPEG)", name);
  check_png(bytes, name);
  ByteImage image(0, 0, channels);
  PngFile file{.in = bytes, .out = "", .fault = ""};
  if (!decode(file, image)) throw DataError("{}: is not a readable image: {}", name, file.fault);
  return image;
}

}  // namespace tacipc
