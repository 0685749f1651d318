// The parts of a Markdown page that tables are made of.
#pragma once

#include <string>
#include <vector>

namespace tacipc {

/// Text that does not end its cell: vertical bars escaped, line breaks as spaces.
std::string markdown_cell(const std::string& text);
/// With these digits after the point; infinity as ∞, NaN as –.
std::string markdown_number(double value, int digits);
/// mean ± deviation, with another word between where given.
std::string markdown_deviation(double mean, double deviation, int digits, const std::string& between = "±");
/// A whole number with a comma every three digits.
std::string markdown_count(double number);

/// A line of a table.
std::string markdown_row(const std::vector<std::string>& cells);
/// The first line of a table and the rule below it.
std::string markdown_head(const std::vector<std::string>& headings);
/// A paragraph below what stands above it; nothing of an empty text.
std::string markdown_paragraph(const std::string& text);
/// A picture in a paragraph of its own; `folder` may be empty.
std::string markdown_picture(const std::string& alt, const std::string& folder, const std::string& file);
/// A file in a folder that may be empty.
std::string in_folder(const std::string& folder, const std::string& file);

}  // namespace tacipc
