// Writes parts of Markdown pages for tables.
#pragma once

#include <string>
#include <vector>

namespace tacipc {

/// Text that cannot end its cell: vertical bars are escaped, line breaks become spaces.
std::string markdown_cell(const std::string& text);
/// Number with these digits after the point; infinity as ∞, NaN as –.
std::string markdown_number(double value, int digits);
/// Text "mean ± deviation"; `between` replaces the sign.
std::string markdown_deviation(double mean, double deviation, int digits, const std::string& between = "±");
/// Whole number with a comma every three digits.
std::string markdown_count(double number);

/// A line of a table.
std::string markdown_row(const std::vector<std::string>& cells);
/// The first line of a table and the rule below it.
std::string markdown_head(const std::vector<std::string>& headings);
/// Paragraph below the preceding text; an empty text gives nothing.
std::string markdown_paragraph(const std::string& text);
/// Picture in a paragraph of its own; `folder` may be empty.
std::string markdown_picture(const std::string& alt, const std::string& folder, const std::string& file);
/// Path of a file in a folder; `folder` may be empty.
std::string in_folder(const std::string& folder, const std::string& file);

}  // namespace tacipc
