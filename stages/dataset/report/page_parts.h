// What the page of a few samples and those of a dataset have in common.
#pragma once

#include <string>

namespace tacipc {

/// From the document's beginning to its body; `style` is a style element or a link to one.
std::string page_head(const std::string& title, const std::string& style);

/// Style sheet: how pages look, and the colours of the indentation picture.
std::string page_style();

/// A number with what it counts, as a list item. Kinds: "", "good", "bad".
std::string tile(const std::string& number, const std::string& words, const std::string& kind = "");

/// "How to read this page": what pictures, curves and numbers mean.
std::string legend();

}  // namespace tacipc
