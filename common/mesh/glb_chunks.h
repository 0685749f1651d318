// A binary glTF file taken apart.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tacipc {

struct GlbChunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// \pre `bytes` begin with "glTF". A JSON chunk that is not padded to four bytes is taken if the next chunk is found.
/// \throw DataError `NAME: …`
GlbChunks glb_chunks(std::string_view bytes, const std::string& name);

/// The bytes of a data URI. \throw DataError `NAME: WHAT …` if it is none, or not in base64.
std::string data_of_uri(std::string_view uri, const std::string& name, const std::string& what);

}  // namespace tacipc
