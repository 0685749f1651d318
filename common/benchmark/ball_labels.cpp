#include "common/benchmark/ball_labels.h"

#include <regex>
#include <sstream>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {

std::vector<BallLabel> read_labels(const std::filesystem::path& path) {
  static const std::regex kLine(R"(\s*(\S+)\s+\(\s*([0-9.]+)\s*,\s*([0-9.]+)\s*\)\s+([0-9.]+)\s*)");
  std::istringstream text(read_file(path));
  std::vector<BallLabel> labels;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    std::smatch match;
    if (!std::regex_match(line, match, kLine))
      throw DataError("{}:{}: expected `image.png (x, y) radius`", path.string(), number);
    const auto value = [&](std::size_t i) { return std::strtod(match[i].str().c_str(), nullptr); };
    labels.push_back({match[1], value(2), value(3), value(4)});
    if (!(labels.back().radius_px > 0.0)) throw DataError("{}:{}: the radius must be positive", path.string(), number);
  }
  if (labels.empty()) throw DataError("{}: holds no labels", path.string());
  return labels;
}

}  // namespace tacipc
