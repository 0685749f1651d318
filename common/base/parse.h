// Parses numbers from texts of files and flags.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace tacipc {

/// Returns the number that the whole text denotes; nothing if it is not a number of this type.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace tacipc
