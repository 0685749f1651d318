#include "common/base/file_name.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/printable.h"

namespace tacipc {
namespace {

constexpr std::size_t kLongest = 200;  // bytes: file systems allow 255, and the project's programs append a suffix

bool is_plain(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  return letter || c == '.' || c == '_' || c == '+' || c == '-';
}

}  // namespace

bool is_file_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongest && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), is_plain);
}

bool is_plain_path(std::string_view path) {
  return !path.empty() && std::all_of(path.begin(), path.end(), [](char c) { return is_plain(c) || c == '/'; });
}

const std::string& require_file_name(const std::string& name, const std::string& where) {
  if (!is_file_name(name)) throw DataError("{}: '{}': {}", where, excerpt(name), kFileNameRule);
  return name;
}

}  // namespace tacipc
