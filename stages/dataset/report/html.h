// Pieces of HTML: heads of pages, tiles, links between folders, numbers people can read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace tacipc {

/// How a page in `folder` names `file`: a relative path with '/', bytes other than letters, digits and -._~/ as %XX.
/// Both are taken as they are written, without following links, as a browser does.
std::string html_link(const std::filesystem::path& file, const std::filesystem::path& folder);

/// A drawing (SVG) above its caption (HTML).
std::string figure(const std::string& svg, const std::string& caption);

/// `value` × `scale` with `digits` significant digits and no exponent between 1e-3 and 1e6; "–" if there is none.
std::string number_text(std::optional<double> value, double scale = 1.0, int digits = 3);
/// Whole numbers with a narrow gap between thousands; "–" if there is none.
std::string count_text(std::optional<std::int64_t> value);

/// From the document's beginning to its body; `style` is a style element or a link to one.
std::string page_head(const std::string& title, const std::string& style);

/// Style sheet: how pages look, and the colours of the indentation picture.
std::string page_style();

/// A number with what it counts, as a list item. Kinds: "", "good", "bad".
std::string tile(const std::string& number, const std::string& words, const std::string& kind = "");

/// "How to read this page": what pictures, curves and numbers mean.
std::string legend();

}  // namespace tacipc
