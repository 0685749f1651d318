#include "common/image/image_jpeg.h"

#include <turbojpeg.h>

#include <cstdint>
#include <memory>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Reference transform, which gives equal pixels on any machine.
constexpr int kExact = TJFLAG_ACCURATEDCT;

/// Largest number of pixels per byte: a block of 8 x 8 of a grey, progressive file takes at least one bit.
constexpr std::uint64_t kPixelsPerByte = 8 * 8 * 8;

using Handle = std::unique_ptr<void, int (*)(tjhandle)>;

}  // namespace

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8\xff"); }

ByteImage decode_jpeg(std::string_view bytes, int channels, const std::string& name) {
  const Handle handle(tjInitDecompress(), tjDestroy);
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, sampling = 0, colors = 0;
  if (tjDecompressHeader3(handle.get(), data, bytes.size(), &width, &height, &sampling, &colors) != 0)
    throw DataError("{}: is not a readable image: {}", name, tjGetErrorStr2(handle.get()));
  const std::uint64_t pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  if (pixels / kPixelsPerByte > bytes.size())
    throw DataError("{}: {} x {} pixels cannot be in a file of {} bytes", name, width, height, bytes.size());
  ByteImage image(width, height, channels);
  if (tjDecompress2(handle.get(), data, bytes.size(), image.pixels.data(), width, 0, height,
                    channels == 1 ? TJPF_GRAY : TJPF_RGB, kExact | TJFLAG_STOPONWARNING) != 0)
    throw DataError("{}: is not a readable image: {}", name, tjGetErrorStr2(handle.get()));
  return image;
}

std::string jpeg_bytes(const ByteImage& image, int quality, const std::string& name) {
  if (image.width < 1 || image.height < 1 || image.channels != 3)
    throw DataError("{}: an image of {} x {} pixels and {} channels is not written (3 channels are)", name, image.width,
                    image.height, image.channels);
  const Handle handle(tjInitCompress(), tjDestroy);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  const int status = tjCompress2(handle.get(), image.pixels.data(), image.width, 0, image.height, TJPF_RGB, &data,
                                 &size, TJSAMP_420, quality, kExact);
  const std::unique_ptr<unsigned char, void (*)(unsigned char*)> bytes(data, tjFree);
  if (status != 0) throw DataError("{}: cannot be written as JPEG: {}", name, tjGetErrorStr2(handle.get()));
  return {bytes.get(), bytes.get() + size};
}

}  // namespace tacipc
