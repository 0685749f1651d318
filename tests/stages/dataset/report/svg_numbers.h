// Numbers that stand in a drawing.
#pragma once

#include <regex>
#include <string>
#include <vector>

namespace tacipc {

/// The first group of every match of a pattern, as numbers.
inline std::vector<double> numbers(const std::string& svg, const std::string& pattern) {
  std::vector<double> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(svg.begin(), svg.end(), regex), end; it != end; ++it)
    found.push_back(std::stod((*it)[1]));
  return found;
}

}  // namespace tacipc
