// Text of unknown origin in messages: control bytes and what is not UTF-8 are shown escaped, long texts are cut.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tacipc {

/// Bytes of the character that a text begins with; 0 where these bytes are no UTF-8, or there are none.
std::size_t utf8_length(std::string_view text);

bool is_utf8(std::string_view text);

/// Text that does to a terminal nothing but print: control characters but tab and the end of a line, and bytes
/// that are no UTF-8, become \x1b and the like.
std::string printable(std::string_view text);

/// A value as a message quotes it: on one line, and where that takes more than `at_most` bytes only the beginning with
/// the size of all.
std::string excerpt(std::string_view text, std::size_t at_most = 80);

}  // namespace tacipc
