// Escapes text for HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace tacipc {

/// Returns text that may stand between tags and inside quoted attributes.
std::string html_text(std::string_view text);

}  // namespace tacipc
