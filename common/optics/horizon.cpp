#include "common/optics/horizon.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tacipc {
namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxCells = 160;         // along the longer side
constexpr int kSearchRadiusCells = 8;  // largest sideways extent of the search, cells
}  // namespace

Horizon::Horizon(const Membrane& membrane) {
  const Vector3 low = membrane.positions.colwise().minCoeff(), high = membrane.positions.colwise().maxCoeff();
  const double deepest = high.z() - low.z();
  low_x_ = low.x();
  low_y_ = low.y();
  const Vector3 size = high - low;
  width_ = std::max({size.x() / kMaxCells, size.y() / kMaxCells, deepest / kFloor / kSearchRadiusCells, 1e-9});
  columns_ = static_cast<int>(size.x() / width_) + 1;
  rows_ = static_cast<int>(size.y() / width_) + 1;
  const auto cells = static_cast<std::size_t>(columns_) * rows_;
  std::vector<double> front(cells, kInfinity), back(cells, -kInfinity), slope(cells, 0.0);  // smallest and largest z
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(j * columns_ + i); };
  for (Eigen::Index f = 0; f < membrane.triangles.rows(); ++f) {
    Matrix3 v;
    for (int k = 0; k < 3; ++k) v.col(k) = membrane.positions.row(membrane.triangles(f, k)).transpose();
    const Vector3 n = (v.col(1) - v.col(0)).cross(v.col(2) - v.col(0));
    const double steep = n.z() > 1e-3 * n.norm() ? n.head<2>().norm() / n.z() : kInfinity;
    const double least = v.row(2).minCoeff(), most = v.row(2).maxCoeff();
    for (int j = cell(v.row(1).minCoeff(), low_y_, rows_); j <= cell(v.row(1).maxCoeff(), low_y_, rows_); ++j) {
      for (int i = cell(v.row(0).minCoeff(), low_x_, columns_); i <= cell(v.row(0).maxCoeff(), low_x_, columns_); ++i) {
        front[at(i, j)] = std::min(front[at(i, j)], least);
        back[at(i, j)] = std::max(back[at(i, j)], most);
        slope[at(i, j)] = std::max(slope[at(i, j)], steep);
      }
    }
  }
  bound_.assign(cells, kFloor);
  std::array<std::array<double, kSearchRadiusCells + 1>, kSearchRadiusCells + 1>
      gap{};  // distance between cells with so many others between them
  for (int j = 0; j <= kSearchRadiusCells; ++j)
    for (int i = 0; i <= kSearchRadiusCells; ++i) gap[j][i] = width_ * std::hypot(i, j);
  tbb::parallel_for(0, rows_, [&](int row) {
    for (int column = 0; column < columns_; ++column) {
      double& bound = bound_[at(column, row)];
      const double here = back[at(column, row)];
      // Nothing farther away is high enough to rise by kFloor.
      const double reach = std::clamp((here - low.z()) / (kFloor * width_), 0.0, double{kSearchRadiusCells});
      const int cells_away = static_cast<int>(reach) + 1;
      for (int j = std::max(0, row - cells_away); j <= std::min(rows_ - 1, row + cells_away); ++j) {
        for (int i = std::max(0, column - cells_away); i <= std::min(columns_ - 1, column + cells_away); ++i) {
          const int across = std::abs(i - column) - 1, along = std::abs(j - row) - 1;
          if (across <= 0 && along <= 0) {
            bound = std::max(bound, slope[at(i, j)]);
          } else {
            const double apart = gap[std::max(0, along)][std::max(0, across)];
            bound = std::max(bound, (here - front[at(i, j)]) / apart);
          }
        }
      }
    }
  });
}

int Horizon::cell(double at, double low, int count) const {
  return std::clamp(static_cast<int>((at - low) / width_), 0, count - 1);
}

double Horizon::steepness(double x, double y) const {
  const double u = (x - low_x_) / width_, v = (y - low_y_) / width_;
  if (!(u >= 0.0 && v >= 0.0 && u < columns_ && v < rows_)) return kInfinity;
  return bound_[static_cast<int>(v) * columns_ + static_cast<int>(u)];
}

}  // namespace tacipc
