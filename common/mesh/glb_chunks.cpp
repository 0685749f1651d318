#include "common/mesh/glb_chunks.h"

#include <array>
#include <cstdint>

#include "common/base/byte_reader.h"
#include "common/base/text_reader.h"

namespace tacipc {
namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;
constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;

/// Returns the binary chunk whose header is at `at`, if there is one.
std::optional<std::string_view> binary_chunk(std::string_view bytes, std::size_t at, const std::string& name) {
  if (at + kChunkHeader > bytes.size()) return std::nullopt;
  ByteReader in(bytes, name);
  in.seek(at);
  const auto length = in.read<std::uint32_t>("a chunk");
  if (in.read<std::uint32_t>("a chunk") != kBinary || length > in.left()) return std::nullopt;
  return bytes.substr(in.at(), length);
}

int value_of_base64(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

}  // namespace

GlbChunks glb_chunks(std::string_view bytes, const std::string& name) {
  ByteReader in(bytes, name);
  in.skip(4, "the header of a binary glTF");
  const auto version = in.read<std::uint32_t>("the header of a binary glTF");
  if (version != 2) throw DataError("{}: is binary glTF of version {}; version 2 is read", name, version);
  const auto length = in.read<std::uint32_t>("the header of a binary glTF");
  if (length > bytes.size()) throw DataError("{}: is cut off: {} of {} bytes", name, bytes.size(), length);
  const auto json = in.read<std::uint32_t>("the JSON chunk");
  if (in.read<std::uint32_t>("the JSON chunk") != kJson)
    throw DataError("{}: its first chunk is not JSON, as that of a binary glTF is", name);
  if (json > in.left())
    throw DataError("{}: its JSON chunk has {} bytes, of which {} are there", name, json, in.left());
  GlbChunks chunks{.json = bytes.substr(in.at(), json), .binary = std::nullopt};
  const std::size_t end = in.at() + json, padded = (end + 3) / 4 * 4;
  chunks.binary = binary_chunk(bytes, end, name);
  if (!chunks.binary && padded != end) chunks.binary = binary_chunk(bytes, padded, name);
  if (!chunks.binary && end + kChunkHeader <= bytes.size())
    throw DataError("{}: no binary chunk follows its JSON chunk of {} bytes{}", name, json,
                    padded != end ? ", which is not padded to four" : "");
  return chunks;
}

std::string data_of_uri(std::string_view uri, const std::string& name, const std::string& what) {
  const std::size_t comma = uri.substr(0, 5) == "data:" ? uri.find(',') : std::string_view::npos;
  if (comma == std::string_view::npos)
    throw DataError("{}: {} is in another file, {}; buffers must be inside the file (as .glb, for example)", name, what,
                    shown(uri));
  if (!uri.substr(0, comma).ends_with(";base64"))
    throw DataError("{}: {} is a data URI that is not in base64", name, what);
  std::string bytes;
  bytes.reserve((uri.size() - comma) / 4 * 3);
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : uri.substr(comma + 1)) {
    if (c == '=') break;  // only padding follows
    const int value = value_of_base64(c);
    if (value < 0) throw DataError("{}: {} has '{}' in its base64", name, what, shown({&c, 1}));
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    if ((held += 6) < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>((bits >> held) & 0xff));
  }
  return bytes;
}

}  // namespace tacipc
