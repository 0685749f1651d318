// Text in HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace tacipc {

/// Text as it may stand between tags and inside quoted attributes.
std::string html_text(std::string_view text);

}  // namespace tacipc
