// Makes text of unknown origin safe for messages: control bytes and invalid UTF-8 are escaped, long texts are cut.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tacipc {

/// Returns the number of bytes of the first character; 0 if the bytes are not valid UTF-8, or the text is empty.
std::size_t utf8_length(std::string_view text);

/// Returns whether the bytes are valid UTF-8.
bool is_utf8(std::string_view text);

/// Returns text that a terminal only prints: control characters except tab and line end, and bytes that are not UTF-8,
/// become \x1b and the like.
std::string printable(std::string_view text);

/// Returns a value as messages quote it: on one line, and if longer than `at_most` bytes, only its beginning with the
/// total size.
std::string excerpt(std::string_view text, std::size_t at_most = 80);

}  // namespace tacipc
