#include <Imath/half.h>
#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfVersion.h>

#include <cmath>
#include <cstring>
#include <exception>
#include <mutex>
#include <type_traits>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/image/exr_header.h"
#include "common/image/image.h"

namespace tacipc {
namespace {

/// Number of worker threads: without any, the order of chunks, and so the bytes, is fixed.
constexpr int kThreads = 0;
/// Compression level of zlib. Level 4, the library's default, makes floats 1 % smaller in a fifth more time.
constexpr int kExrCompression = 1;

/// Writes to memory, so that disk errors come from write_file().
class MemoryOut final : public Imf::OStream {
 public:
  MemoryOut() : OStream("memory") {}
  void write(const char* bytes, int count) override {
    const std::size_t end = at_ + static_cast<std::size_t>(count);
    if (end > bytes_.size()) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, bytes, static_cast<std::size_t>(count));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

class MemoryIn final : public Imf::IStream {
 public:
  explicit MemoryIn(const std::string& bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char* target, int count) override {
    const auto wanted = static_cast<std::size_t>(count);
    if (at_ > bytes_.size() || wanted > bytes_.size() - at_) throw std::runtime_error("the file ends too early");
    std::memcpy(target, bytes_.data() + at_, wanted);
    at_ += wanted;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override { at_ = position; }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// Makes a slice. Imf addresses pixels from (0, 0) of the image plane, which need not be in the data window.
template <typename T>
Imf::Slice slice(const Image<T>& image, int channel, int x_min, int y_min) {
  const auto x_stride = sizeof(T) * image.channels;
  const auto y_stride = x_stride * static_cast<std::size_t>(image.width);
  auto* first = reinterpret_cast<char*>(const_cast<T*>(image.pixels.data() + channel));
  char* origin = first - static_cast<std::ptrdiff_t>(x_stride) * x_min - static_cast<std::ptrdiff_t>(y_stride) * y_min;
  return Imf::Slice(std::is_same_v<T, half> ? Imf::HALF : Imf::FLOAT, origin, x_stride, y_stride);
}

/// Converts to halves.
/// \throw DataError if a number is too large
Image<half> halves_of(const FloatImage& image, const std::string& name) {
  Image<half> halves(image.width, image.height, image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    halves.pixels[i] = half(image.pixels[i]);
    if (halves.pixels[i].isInfinity() && std::isfinite(image.pixels[i]))
      throw DataError("{}: {} is too large for a half float", name, image.pixels[i]);
  }
  return halves;
}

template <typename T>
std::string exr_bytes(const Image<T>& image, const std::vector<std::string>& channel_names, const std::string& name) {
  MemoryOut memory;
  try {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.zipCompressionLevel() = kExrCompression;
    Imf::FrameBuffer frame;
    for (int c = 0; c < image.channels; ++c) {
      const Imf::Slice part = slice(image, c, 0, 0);
      header.channels().insert(channel_names[c], Imf::Channel(part.type));
      frame.insert(channel_names[c], part);
    }
    Imf::OutputFile file(memory, header, kThreads);
    file.setFrameBuffer(frame);
    file.writePixels(image.height);
  } catch (const std::exception& error) {
    throw DataError("{}: cannot be written: {}", name, error.what());
  }
  return memory.bytes();
}

std::string channel_list(const Imf::ChannelList& channels) {
  std::string text;
  for (auto it = channels.begin(); it != channels.end(); ++it)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", it.name());
  return text.empty() ? "none" : text;
}

}  // namespace

void write_exr(const std::filesystem::path& path, const FloatImage& image,
               const std::vector<std::string>& channel_names, ExrNumbers numbers) {
  const std::string name = path.string();
  if (image.width < 1 || image.height < 1 || image.pixels.empty())
    throw DataError("{}: an image of {} x {} pixels is not written", name, image.width, image.height);
  if (channel_names.size() != static_cast<std::size_t>(image.channels))
    throw DataError("{}: {} channel names for {} channels", name, channel_names.size(), image.channels);
  write_file(path, numbers == ExrNumbers::halves ? exr_bytes(halves_of(image, name), channel_names, name)
                                                 : exr_bytes(image, channel_names, name));
}

FloatImage read_exr(const std::filesystem::path& path, const std::vector<std::string>& channel_names) {
  const std::string name = path.string();
  const std::string bytes = read_file(path);
  if (bytes.size() >= 4 && Imf::isImfMagic(bytes.data())) check_exr_header(bytes, name);
  static std::once_flag limits;
  std::call_once(limits, [] {
    constexpr int kSide = kLargestExrSide;
    Imf::Header::setMaxImageSize(kSide, kSide);
    Imf::Header::setMaxTileSize(kSide, kSide);
  });
  try {
    MemoryIn memory(bytes);
    Imf::InputFile file(memory, kThreads);
    const Imf::ChannelList& channels = file.header().channels();
    for (const std::string& channel : channel_names)
      if (channels.findChannel(channel.c_str()) == nullptr)
        throw DataError("{}: has no channel '{}' (it has: {})", name, channel, channel_list(channels));
    const auto& window = file.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    const std::uint64_t needed = static_cast<std::uint64_t>(width * height) * channel_names.size() * sizeof(float);
    if (width < 1 || height < 1 || needed / kLargestExrRatio > bytes.size())
      throw DataError("{}: {} x {} pixels cannot be in a file of {} bytes", name, width, height, bytes.size());
    FloatImage image(static_cast<int>(width), static_cast<int>(height), static_cast<int>(channel_names.size()));
    Imf::FrameBuffer frame;
    for (int c = 0; c < image.channels; ++c)
      frame.insert(channel_names[c], slice(image, c, window.min.x, window.min.y));
    file.setFrameBuffer(frame);
    file.readPixels(window.min.y, window.max.y);
    return image;
  } catch (const DataError&) {
    throw;
  } catch (const std::exception& error) {
    throw DataError("{}: is not a readable EXR image: {}", name, error.what());
  }
}

}  // namespace tacipc
