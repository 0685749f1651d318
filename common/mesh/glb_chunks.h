// Splits a binary glTF file into its chunks.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tacipc {

/// Chunks of a file; they refer to the file's bytes.
struct GlbChunks {
  std::string_view json;
  std::optional<std::string_view> binary;
};

/// Returns the chunks of a file. A JSON chunk that is not padded to four bytes is accepted if the next chunk is found.
/// \pre `bytes` begin with "glTF"
/// \throw DataError `NAME: …` if the file is damaged
GlbChunks glb_chunks(std::string_view bytes, const std::string& name);

/// Returns the bytes of a data URI.
/// \throw DataError `NAME: WHAT …` if it is not a data URI, or not in base64
std::string data_of_uri(std::string_view uri, const std::string& name, const std::string& what);

}  // namespace tacipc
