#include "common/checked_file.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <system_error>

#include "common/error.h"
#include "common/files.h"

namespace tacipc {
namespace {

std::string first_line(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("checked {} {:016x}{:016x}\n", bytes.size(), hash.high64, hash.low64);
}

}  // namespace

void write_checked_file(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path beside = path.string() + ".partial";
  write_file(beside, first_line(bytes).append(bytes));
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error) throw DataError("{}: cannot be written: {}", path.string(), error.message());
}

std::optional<std::string> read_checked_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  std::string bytes = read_file(path);
  const std::size_t end = bytes.find('\n');
  if (end == std::string::npos) return std::nullopt;
  const std::string line = bytes.substr(0, end + 1);
  bytes.erase(0, end + 1);
  if (line != first_line(bytes)) return std::nullopt;
  return bytes;
}

}  // namespace tacipc
