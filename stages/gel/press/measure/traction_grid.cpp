#include "stages/gel/press/measure/traction_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tacipc {
namespace {

constexpr int kPartsPerCell = 4;  // parts of a triangle's edge per cell
/// Largest number of parts of an edge, reached by a triangle as large as a hundred cells.
constexpr double kMaxParts = 512;

using NormalAndFriction = Eigen::Matrix<double, 6, 1>;

/// Two neighbouring cells along one axis, and the weight of the second.
struct Neighbours {
  int first, second;
  double weight;
};

/// Cells nearest to `place`, measured in cells from the rectangle's edge; cell number i has its centre at i + ½.
Neighbours nearest_cells(double place, int cells) {
  const double from_center = std::clamp(place - 0.5, 0.0, cells - 1.0);
  const int first = std::min(static_cast<int>(from_center), cells - 1);
  return {first, std::min(first + 1, cells - 1), from_center - first};
}

class Cells {
 public:
  explicit Cells(const TractionGrid& grid)
      : grid_(grid), force_n_(static_cast<std::size_t>(grid.rows) * grid.columns, NormalAndFriction::Zero()) {}

  /// (column, row) coordinates of a point, in cells from the rectangle's first corner.
  Eigen::Vector2d place(const Vector3& point) const {
    return {((point.x() - grid_.center_x_m) / grid_.width_m + 0.5) * grid_.columns,
            ((point.y() - grid_.center_y_m) / grid_.height_m + 0.5) * grid_.rows};
  }
  bool inside(const Eigen::Vector2d& place) const {
    return place.x() >= 0.0 && place.x() <= grid_.columns && place.y() >= 0.0 && place.y() <= grid_.rows;
  }
  void add(const Eigen::Vector2d& place, const NormalAndFriction& force_n) {
    const Neighbours x = nearest_cells(place.x(), grid_.columns), y = nearest_cells(place.y(), grid_.rows);
    cell(y.first, x.first) += (1.0 - y.weight) * (1.0 - x.weight) * force_n;
    cell(y.first, x.second) += (1.0 - y.weight) * x.weight * force_n;
    cell(y.second, x.first) += y.weight * (1.0 - x.weight) * force_n;
    cell(y.second, x.second) += y.weight * x.weight * force_n;
  }
  std::vector<double> pascal() const {
    std::vector<double> all;
    all.reserve(6 * force_n_.size());
    for (const NormalAndFriction& force : force_n_) {
      for (int i = 0; i < 6; ++i) all.push_back(force[i] / grid_.cell_area_m2());
    }
    return all;
  }

 private:
  NormalAndFriction& cell(int row, int column) {
    return force_n_[static_cast<std::size_t>(row) * grid_.columns + column];
  }

  const TractionGrid& grid_;
  std::vector<NormalAndFriction> force_n_;
};

/// Calls use(weights) with the barycentric coordinates of the centres of the n² equal parts of a triangle. The mean of
/// each coordinate over them is 1/3, so that linear functions are integrated exactly.
template <typename Use>
void for_each_part(int n, Use&& use) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const auto center = [&](double third) {
        const double a = (i + third) / n, b = (j + third) / n;
        use(Vector3(1.0 - a - b, a, b));
      };
      center(1.0 / 3.0);
      if (i + j + 1 < n) center(2.0 / 3.0);
    }
  }
}

}  // namespace

TractionGrid TractionGrid::over_window(const Camera& camera) {
  return {.center_x_m = camera.position_m.x(),
          .center_y_m = camera.position_m.y(),
          .width_m = camera.window_width_m,
          .height_m = camera.window_height_m};
}

std::vector<double> spread_traction(const TractionGrid& grid, const FrontSurface& front,
                                    const Positions& front_positions, const Positions& normal_n,
                                    const Positions& friction_n) {
  Cells cells(grid);
  const std::vector<double> area = triangle_areas(front, front_positions);
  const std::vector<double> around = lumped_areas(front, front_positions);
  std::vector<NormalAndFriction> force_n(front.vertices.size(), NormalAndFriction::Zero());
  for (std::size_t v = 0; v < front.vertices.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    NormalAndFriction force;
    force << normal_n.row(row).transpose(), friction_n.row(row).transpose();
    const Eigen::Vector2d place = cells.place(front_positions.row(row));
    if (!cells.inside(place)) continue;
    if (around[v] > 0.0) {
      force_n[v] = force;
    } else {
      cells.add(place, force);  // all triangles around the vertex have collapsed
    }
  }
  for (Eigen::Index f = 0; f < front.triangles.rows(); ++f) {
    std::array<NormalAndFriction, 3> share;
    std::array<Eigen::Vector2d, 3> corner;
    bool loaded = false;
    for (int c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(front.triangles(f, c));
      corner[c] = cells.place(front_positions.row(front.triangles(f, c)));
      share[c].setZero();
      if (force_n[v].isZero(0.0)) continue;
      share[c] = force_n[v] * (area[static_cast<std::size_t>(f)] / (3.0 * around[v]));
      loaded = true;
    }
    if (!loaded) continue;
    double longest = 0.0;
    for (int c = 0; c < 3; ++c)
      longest = std::max(longest, (corner[(c + 1) % 3] - corner[c]).lpNorm<Eigen::Infinity>());
    const int n = static_cast<int>(std::clamp(std::ceil(kPartsPerCell * longest), 1.0, kMaxParts));
    // The share of a corner times its weight (mean 1/3 over the n² parts) sums to the share.
    for_each_part(n, [&](const Vector3& weights) {
      const Eigen::Vector2d place = weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2];
      cells.add(place, (weights[0] * share[0] + weights[1] * share[1] + weights[2] * share[2]) * (3.0 / (n * n)));
    });
  }
  return cells.pascal();
}

}  // namespace tacipc
