#include "common/image/exr_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "common/base/byte_reader.h"
#include "common/base/error.h"
#include "common/base/text_reader.h"

namespace tacipc {
namespace {

constexpr std::string_view kPlace = "the EXR header";
constexpr std::uint32_t kMultiPart = 0x1000;

struct FixedType {
  std::string_view name;
  std::size_t size;  // bytes
};
/// Types of fixed size. For others (string, floatvector, unknown ones) the library uses the size in the file.
constexpr std::array<FixedType, 24> kFixedTypes{{{"box2f", 16},
                                                 {"box2i", 16},
                                                 {"chromaticities", 32},
                                                 {"compression", 1},
                                                 {"double", 8},
                                                 {"envmap", 1},
                                                 {"deepImageState", 1},
                                                 {"float", 4},
                                                 {"int", 4},
                                                 {"keycode", 28},
                                                 {"lineOrder", 1},
                                                 {"m33f", 36},
                                                 {"m33d", 72},
                                                 {"m44f", 64},
                                                 {"m44d", 128},
                                                 {"rational", 8},
                                                 {"tiledesc", 9},
                                                 {"timecode", 8},
                                                 {"v2f", 8},
                                                 {"v2i", 8},
                                                 {"v2d", 16},
                                                 {"v3f", 12},
                                                 {"v3i", 12},
                                                 {"v3d", 24}}};

std::string text(ByteReader& in) {
  std::string found;
  while (const char c = in.read<char>(kPlace)) found += c;
  return found;
}

/// Returns the size of the channel list: each channel is a name and 16 bytes; an empty name ends the list.
std::size_t channels_size(ByteReader in) {
  const std::size_t begin = in.at();
  while (!text(in).empty()) in.skip(16, "an EXR channel");
  return in.at() - begin;
}

std::size_t preview_size(ByteReader in) {
  const std::uint64_t width = in.read<std::uint32_t>("an EXR preview"),
                      height = in.read<std::uint32_t>("an EXR preview");
  std::uint64_t size = 0;
  if (__builtin_mul_overflow(width * height, std::uint64_t{4}, &size) || size > in.left())
    in.fail(fmt::format("a preview of {} x {} pixels does not fit into the file", width, height));
  return size + 8;
}

/// Returns the size of an attribute of this type; nothing if the file gives it.
std::optional<std::size_t> size_of(const std::string& type, const ByteReader& in) {
  for (const FixedType& fixed : kFixedTypes)
    if (fixed.name == type) return fixed.size;
  if (type == "chlist") return channels_size(in);
  if (type == "preview") return preview_size(in);
  if (type == "idmanifest") in.fail("attributes of type 'idmanifest' are not supported");
  return std::nullopt;
}

struct Sizes {
  std::uint64_t width = 0, height = 0;            // size of the data window
  std::uint64_t tile_width = 0, tile_height = 0;  // 0: no tiles
};

void note_sizes(const std::string& attribute, const std::string& type, ByteReader in, Sizes& sizes) {
  if (attribute == "dataWindow" && type == "box2i") {
    std::array<std::int64_t, 4> box;
    for (std::int64_t& side : box) side = in.read<std::int32_t>(kPlace);
    sizes.width = static_cast<std::uint64_t>(std::max<std::int64_t>(box[2] - box[0] + 1, 0));
    sizes.height = static_cast<std::uint64_t>(std::max<std::int64_t>(box[3] - box[1] + 1, 0));
  }
  if (attribute == "tiles" && type == "tiledesc") {
    sizes.tile_width = in.read<std::uint32_t>(kPlace);
    sizes.tile_height = in.read<std::uint32_t>(kPlace);
  }
}

/// Checks the tile table, of 8 bytes per tile. The library allocates the table, and one tile, before it reads anything.
void check_sizes(const Sizes& sizes, std::size_t file_size, const std::string& name) {
  if (sizes.width > kLargestExrSide || sizes.height > kLargestExrSide ||
      sizes.width * sizes.height / kLargestExrRatio > file_size)
    throw DataError("{}: {} x {} pixels cannot be in a file of {} bytes", name, sizes.width, sizes.height, file_size);
  if (sizes.tile_width == 0 || sizes.tile_height == 0) return;
  if (sizes.tile_width > kLargestExrTile / sizes.tile_height)
    throw DataError("{}: tiles of {} x {} pixels are too large", name, sizes.tile_width, sizes.tile_height);
  const std::uint64_t tiles = ((sizes.width - 1) / sizes.tile_width + 1) * ((sizes.height - 1) / sizes.tile_height + 1);
  if (sizes.width > 0 && sizes.height > 0 && tiles * 8 > file_size)
    throw DataError("{}: {} tiles cannot be in a file of {} bytes", name, tiles, file_size);
}

/// Checks a list of attributes `name\0 type\0 size value`, ended by an empty name.
/// \return false if the list is empty
bool check_part(ByteReader& in, std::size_t file_size) {
  Sizes sizes;
  bool empty = true;
  for (std::string attribute = text(in); !attribute.empty(); attribute = text(in), empty = false) {
    const std::string type = text(in);
    const auto size = in.read<std::int32_t>(kPlace);
    if (size < 0) in.fail(fmt::format("attribute size {} is negative", size));
    const std::size_t needed = size_of(type, in).value_or(static_cast<std::size_t>(size));
    if (needed != static_cast<std::size_t>(size))
      in.fail(fmt::format("attribute '{}' of type '{}' takes {} bytes, the header says {}", shown(attribute), type,
                          needed, size));
    note_sizes(attribute, type, in, sizes);
    in.skip(needed, "an EXR attribute");
  }
  check_sizes(sizes, file_size, in.name());
  return !empty;
}

}  // namespace

void check_exr_header(std::string_view bytes, const std::string& name) {
  ByteReader in(bytes, name);
  in.skip(4, "the magic");
  const bool several_parts = (in.read<std::uint32_t>(kPlace) & kMultiPart) != 0;
  while (check_part(in, bytes.size()) && several_parts) {
  }
}

}  // namespace tacipc
