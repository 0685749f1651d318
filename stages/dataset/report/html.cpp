#include "stages/dataset/report/html.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "common/format/html_text.h"
#include "common/image/picture.h"
#include "tacipc_report_texts.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Style with the colours of the indentation picture.
std::string color_bar_style() {
  constexpr int kStops = 17;
  std::string stops;
  for (int i = 0; i < kStops; ++i) {
    const double t = static_cast<double>(i) / (kStops - 1);
    const auto [r, g, b] = perceptual_color(t);
    stops += fmt::format(", rgb({} {} {}) {:g}%", r, g, b, 100.0 * t);
  }
  return ".bar i { background: linear-gradient(90deg" + stops + "); }\n";
}

}  // namespace

std::string html_link(const fs::path& file, const fs::path& folder) {
  const fs::path from = fs::absolute(folder).lexically_normal();
  const fs::path to = fs::absolute(file).lexically_normal();
  const std::string path = to.lexically_relative(from.has_filename() ? from : from.parent_path()).generic_string();
  std::string link;
  for (const char c : path) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    link += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return link;
}

std::string figure(const std::string& svg, const std::string& caption) {
  return "<figure>" + svg + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string number_text(std::optional<double> value, double scale, int digits) {
  if (!value) return "–";
  const double scaled = *value * scale;
  if (scaled == 0.0) return "0";
  // Exponent after rounding: 9.996 has two digits before the point, like 10.0.
  const std::string scientific = fmt::format("{:.{}e}", scaled, digits - 1);
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
  if (exponent < -3 || exponent >= 6) return scientific;
  return fmt::format("{:.{}f}", scaled, std::max(0, digits - 1 - exponent));
}

std::string count_text(std::optional<std::int64_t> value) {
  if (!value) return "–";
  std::string digits = fmt::format("{}", *value);
  constexpr std::string_view kThinSpace = "\u202f";
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), kThinSpace);
  return digits;
}

std::string page_head(const std::string& title, const std::string& style) {
  return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         html_text(title) + "</title>\n" + style + "\n</head>\n";
}

std::string page_style() { return std::string("\n") + kPageStyle + color_bar_style(); }

std::string tile(const std::string& number, const std::string& words, const std::string& kind) {
  return fmt::format("<li class=\"{}\"><b>{}</b>{}</li>\n", kind, number, words);
}

std::string legend() { return kLegend; }

}  // namespace tacipc
