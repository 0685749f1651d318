#include "common/benchmark/marker_lattice.h"

#include <algorithm>
#include <array>
#include <vector>

#include "common/base/error.h"

namespace tacipc {
namespace {

constexpr double kTolerance = 1e-3;  // of the spacing

/// Distinct values among ascending ones.
std::vector<double> distinct(std::vector<double> values) {
  std::ranges::sort(values);
  const double tolerance = kTolerance * (values.back() - values.front()) / static_cast<double>(values.size());
  std::vector<double> out;
  for (const double v : values)
    if (out.empty() || v - out.back() > tolerance) out.push_back(v);
  return out;
}

/// Catmull–Rom's weights of four values at −1, 0, 1, 2 for a point at t in [0, 1].
std::array<double, 4> catmull_rom(double t) {
  return {0.5 * t * (-1.0 + t * (2.0 - t)), 1.0 + 0.5 * t * t * (-5.0 + 3.0 * t), 0.5 * t * (1.0 + t * (4.0 - 3.0 * t)),
          0.5 * t * t * (t - 1.0)};
}

}  // namespace

MarkerLattice::MarkerLattice(const Positions& rest_m, const std::string& source) : source_(source) {
  const auto no_lattice = [&] {
    throw DataError("{}: the markers at rest are not a lattice of rows and columns", source);
  };
  const Eigen::Index markers = rest_m.rows();
  if (markers < 16) no_lattice();
  for (int k = 0; k < 2; ++k) {
    const std::vector<double> lines = distinct({rest_m.col(k).begin(), rest_m.col(k).end()});
    if (lines.size() < 4) no_lattice();
    first_m_[k] = lines.front();
    count_[k] = static_cast<int>(lines.size());
    spacing_m_[k] = (lines.back() - lines.front()) / static_cast<double>(lines.size() - 1);
  }
  if (Eigen::Index{count_.x()} * count_.y() != markers) no_lattice();
  marker_ = Eigen::MatrixXi::Constant(count_.y(), count_.x(), -1);
  for (Eigen::Index m = 0; m < markers; ++m) {
    const Eigen::Vector2d place = (rest_m.row(m).head<2>().transpose() - first_m_).cwiseQuotient(spacing_m_);
    const Eigen::Vector2d whole = place.array().round().matrix();
    if ((place - whole).cwiseAbs().maxCoeff() > kTolerance) no_lattice();
    int& here = marker_(static_cast<int>(whole.y()), static_cast<int>(whole.x()));
    if (here >= 0) no_lattice();
    here = static_cast<int>(m);
  }
}

Vector3 MarkerLattice::at(const Eigen::Vector2d& point_m, const Positions& vectors) const {
  const Eigen::Vector2d place = (point_m - first_m_).cwiseQuotient(spacing_m_);
  std::array<std::array<double, 4>, 2> weight{};
  Eigen::Vector2i cell;
  for (int k = 0; k < 2; ++k) {
    if (!(place[k] >= 0.0 && place[k] <= count_[k] - 1))
      throw DataError("{}: a measured marker at ({:.3f}, {:.3f}) mm lies outside the simulated ones", source_,
                      1e3 * point_m.x(), 1e3 * point_m.y());
    cell[k] = std::min(static_cast<int>(place[k]), count_[k] - 2);
    auto& w = weight[k] = catmull_rom(place[k] - cell[k]);
    // Beyond the edge the field is extrapolated linearly: v(−1) = 2 v(0) − v(1).
    if (cell[k] == 0) {
      w[1] += 2.0 * w[0];
      w[2] -= w[0];
      w[0] = 0.0;
    }
    if (cell[k] == count_[k] - 2) {
      w[2] += 2.0 * w[3];
      w[1] -= w[3];
      w[3] = 0.0;
    }
  }
  Vector3 sum = Vector3::Zero();
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const double w = weight[0][i] * weight[1][j];
      if (w == 0.0) continue;
      sum += w * vectors.row(marker_(cell.y() + j - 1, cell.x() + i - 1)).transpose();
    }
  return sum;
}

}  // namespace tacipc
