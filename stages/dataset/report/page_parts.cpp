#include "stages/dataset/report/page_parts.h"

#include <fmt/core.h>

#include "common/format/html_text.h"
#include "common/image/picture.h"
#include "tacipc_report_texts.h"

namespace tacipc {
namespace {

/// The colours of the indentation picture as a style of their own.
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
