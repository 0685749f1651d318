#include "common/base/checked_file.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <system_error>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace {

std::string first_line(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return fmt::format("checked {} {:016x}{:016x}\n", bytes.size(), hash.high64, hash.low64);
}

void put_in_place(const std::filesystem::path& beside, const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error) throw DataError("{}: cannot be written: {}", path.string(), error.message());
}

}  // namespace

void write_checked_file(const std::filesystem::path& path, std::string_view bytes) {
  const std::filesystem::path beside = path.string() + ".partial";
  write_file(beside, first_line(bytes).append(bytes));
  put_in_place(beside, path);
}

bool replace_if_changed(const std::filesystem::path& path, const std::string& text) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored) && read_file(path) == text) return false;
  const std::filesystem::path beside = path.parent_path() / fmt::format(".{}", path.filename().string());
  write_file(beside, text);
  flush_to_disk({beside});
  put_in_place(beside, path);
  return true;
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
