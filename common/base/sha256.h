// SHA-256, what `sha256sum -c` checks on the other side.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tacipc {

/// The digest as 64 hex digits.
std::string sha256(std::string_view bytes);
/// Of a file of any size. \throw DataError if it cannot be read
std::string sha256_of_file(const std::filesystem::path& path);
/// Digest of a file whose name with `.sha256` behind it holds the same, as sha256sum writes it.
/// \throw DataError if that file is missing or says another one: the file is damaged
std::string checked_sha256(const std::filesystem::path& path);

}  // namespace tacipc
