#include "common/benchmark/measured_field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <vector>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/statistics.h"

namespace tacipc {

MarkerField read_marker_field(const std::filesystem::path& path) {
  std::istringstream text(read_file(path));
  std::string line;
  std::vector<double> rows;
  for (int number = 1; std::getline(text, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (number == 1) {
      if (line != "Mx,My,dx,dy") throw DataError("{}:1: expected the header Mx,My,dx,dy", path.string());
      continue;
    }
    if (line.empty()) continue;
    double v[4];
    int end = 0;
    const bool read = std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf%n", v, v + 1, v + 2, v + 3, &end) == 4 &&
                      end == static_cast<int>(line.size());
    if (!read || !std::all_of(v, v + 4, [](double x) { return std::isfinite(x); }))
      throw DataError("{}:{}: expected four numbers", path.string(), number);
    rows.insert(rows.end(), v, v + 4);
  }
  if (rows.empty()) throw DataError("{}: has no markers", path.string());
  const Eigen::Map<Eigen::Matrix4Xd> all(rows.data(), 4, static_cast<Eigen::Index>(rows.size() / 4));
  return {.rest_px = all.topRows<2>(), .moved_px = all.bottomRows<2>()};
}

Eigen::Vector2d median_of(const Eigen::Matrix2Xd& vectors) {
  assert(vectors.cols() > 0);
  Eigen::Vector2d medians;
  for (int k = 0; k < 2; ++k) {
    std::vector<double> v;
    for (const double value : vectors.row(k)) v.push_back(value);
    medians[k] = median(std::move(v));
  }
  return medians;
}

}  // namespace tacipc
