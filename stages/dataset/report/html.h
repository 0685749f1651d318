// Parts of HTML: heads of pages, tiles, links between folders, readable numbers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace tacipc {

/// Link from a page in `folder` to `file`: a relative path with '/', bytes other than letters, digits and -._~/ as %XX.
/// As in a browser, symbolic links in both are not followed.
std::string html_link(const std::filesystem::path& file, const std::filesystem::path& folder);

/// A drawing (SVG) above its caption (HTML).
std::string figure(const std::string& svg, const std::string& caption);

/// Text of `value` × `scale` with `digits` significant digits, without exponent between 1e-3 and 1e6; "–" without a
/// value.
std::string number_text(std::optional<double> value, double scale = 1.0, int digits = 3);
/// Whole number with a narrow gap between thousands; "–" without a value.
std::string count_text(std::optional<std::int64_t> value);

/// Beginning of the document up to its body; `style` is a style element or a link to one.
std::string page_head(const std::string& title, const std::string& style);

/// Style sheet of pages, with the colours of the indentation picture.
std::string page_style();

/// Number and its label as a list item. Kinds: "", "good", "bad".
std::string tile(const std::string& number, const std::string& words, const std::string& kind = "");

/// Section "How to read this page": meanings of pictures, curves and numbers.
std::string legend();

}  // namespace tacipc
