#include "stages/dataset/report/html.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

namespace tacipc {
namespace fs = std::filesystem;

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
  // The exponent after rounding: 9.996 has two digits before the point, as 10.0.
  const std::string scientific = fmt::format("{:.{}e}", scaled, digits - 1);
  const int exponent = std::stoi(scientific.substr(scientific.find('e') + 1));
  if (exponent < -3 || exponent >= 6) return scientific;
  return fmt::format("{:.{}f}", scaled, std::max(0, digits - 1 - exponent));
}

std::string count_text(std::optional<int> value) {
  if (!value) return "–";
  std::string digits = fmt::format("{}", *value);
  constexpr std::string_view kThinSpace = "\u202f";
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), kThinSpace);
  return digits;
}

}  // namespace tacipc
