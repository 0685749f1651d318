#include "stages/study/tabulate/markdown.h"

#include <fmt/core.h>

#include <cmath>

namespace tacipc {

std::string markdown_cell(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string markdown_number(double value, int digits) {
  if (std::isinf(value)) return "∞";
  return std::isnan(value) ? "–" : fmt::format("{:.{}f}", value, digits);
}

std::string markdown_deviation(double mean, double deviation, int digits, const std::string& between) {
  return markdown_number(mean, digits) + " " + between + " " + markdown_number(deviation, digits);
}

std::string markdown_count(double number) {
  const std::string digits = fmt::format("{:.0f}", number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += (cell.empty() ? "" : " " + cell) + " |";
  return text + "\n";
}

std::string markdown_head(const std::vector<std::string>& headings) {
  std::string rule = "|";
  for (std::size_t i = 0; i < headings.size(); ++i) rule += "---|";
  return markdown_row(headings) + rule + "\n";
}

std::string markdown_paragraph(const std::string& text) {
  return text.empty() ? "" : "\n" + text + (text.ends_with('\n') ? "" : "\n");
}

std::string markdown_picture(const std::string& alt, const std::string& folder, const std::string& file) {
  return fmt::format("\n![{}]({})\n", alt, in_folder(folder, file));
}

std::string in_folder(const std::string& folder, const std::string& file) {
  return folder.empty() ? file : folder + "/" + file;
}

}  // namespace tacipc
