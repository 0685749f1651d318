// SHA-256 digests, compatible with `sha256sum -c`.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tacipc {

/// Returns the digest as 64 hex digits.
std::string sha256(std::string_view bytes);
/// Returns the digest of a file of any size.
/// \throw DataError if it cannot be read
std::string sha256_of_file(const std::filesystem::path& path);
/// Returns the digest of a file after comparing it with the one stored in the file with suffix `.sha256`, as sha256sum
/// writes it.
/// \throw DataError if that file is missing or has another digest, so the file is damaged
std::string checked_sha256(const std::filesystem::path& path);

}  // namespace tacipc
