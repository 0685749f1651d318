#include "stages/rival/mpm/gel_lattice.h"

#include <cmath>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Tolerance for a spacing that divides a length only in decimal numbers.
constexpr double kRounding = 1e-9;

/// Number of positions along an axis of this length: at its ends and between, or in the middles of its intervals.
int places(double length_m, const LatticeConfig& config) {
  const int intervals = static_cast<int>(std::floor(length_m / config.spacing_m * (1.0 + kRounding)));
  return config.on_faces ? intervals + 1 : intervals;
}

/// Positive if d lies inside the circle through a, b, c.
/// \pre a, b, c are counter-clockwise
double in_circle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                 const Eigen::Vector2d& d) {
  Matrix3 rows;
  int r = 0;
  for (const Eigen::Vector2d& corner : {a, b, c}) {
    const Eigen::Vector2d to = corner - d;
    rows.row(r++) << to.x(), to.y(), to.squaredNorm();
  }
  return rows.determinant();
}

}  // namespace

GelLattice make_gel_lattice(const LatticeConfig& config, const GelShape& gel) {
  GelLattice lattice;
  lattice.spacing_m = config.spacing_m;
  if (config.counts) {
    lattice.sides = {(*config.counts)[0], (*config.counts)[1]};
    lattice.layers = (*config.counts)[2];
    lattice.thickness_m = config.spacing_m * (lattice.layers - (config.on_faces ? 1 : 0));
  } else {
    if (gel.dome_radius_m) throw DataError("the sensor's gel is domed; material points fill flat gels only");
    const bool disc = gel.outline == GelShape::Outline::disc;
    lattice.sides = {places(disc ? 2.0 * gel.radius_m : gel.width_m, config),
                     places(disc ? 2.0 * gel.radius_m : gel.height_m, config)};
    lattice.layers = places(gel.thickness_m, config);
    lattice.thickness_m = gel.thickness_m;
    const double intervals = gel.thickness_m / config.spacing_m;
    if (std::abs(intervals - std::round(intervals)) > 1e-6)
      throw DataError("the gel's thickness of {:.6g} mm is not a multiple of the spacing of {:.6g} mm",
                      1e3 * gel.thickness_m, 1e3 * config.spacing_m);
  }
  if (lattice.sides[0] < 2 || lattice.sides[1] < 2)
    throw DataError("a spacing of {:.6g} mm leaves {} x {} columns of particles; at least 2 x 2 are needed",
                    1e3 * config.spacing_m, lattice.sides[0], lattice.sides[1]);
  if (lattice.layers <= config.fixed_layers.value_or(0))
    throw DataError("the gel has {} layers of particles; {} are fixed", lattice.layers,
                    config.fixed_layers.value_or(0));

  const auto place = [&](int i, std::size_t axis) { return (i - 0.5 * (lattice.sides[axis] - 1)) * lattice.spacing_m; };
  lattice.column_at.assign(static_cast<std::size_t>(lattice.sides[0] * lattice.sides[1]), -1);
  for (int i = 0; i < lattice.sides[0]; ++i) {
    for (int j = 0; j < lattice.sides[1]; ++j) {
      const double inside = 1.0 - kRounding;
      if (!config.counts && !gel.contains(inside * place(i, 0), inside * place(j, 1))) continue;
      lattice.column_at[i * lattice.sides[1] + j] = lattice.num_columns();
      lattice.columns.push_back({i, j});
    }
  }
  const double below_front_m = config.on_faces ? 0.0 : 0.5 * lattice.spacing_m;
  lattice.rest_m.resize(static_cast<Eigen::Index>(lattice.layers) * lattice.num_columns(), 3);
  Eigen::Index row = 0;
  for (int layer = 0; layer < lattice.layers; ++layer)
    for (const auto& [i, j] : lattice.columns)
      lattice.rest_m.row(row++) << place(i, 0), place(j, 1),
          -below_front_m - (lattice.layers - 1 - layer) * lattice.spacing_m;
  return lattice;
}

Positions front_at_rest(const GelLattice& lattice) {
  Positions front = lattice.rest_m.bottomRows(lattice.num_columns());
  front.col(2).setZero();
  return front;
}

Triangles triangulate(const GelLattice& lattice, const Positions& positions) {
  std::vector<std::array<int, 3>> all;
  for (int i = 0; i + 1 < lattice.sides[0]; ++i) {
    for (int j = 0; j + 1 < lattice.sides[1]; ++j) {
      // Corners counter-clockwise, seen from above.
      const std::array<int, 4> corner{lattice.at(i, j), lattice.at(i + 1, j), lattice.at(i + 1, j + 1),
                                      lattice.at(i, j + 1)};
      int missing = 0, without = 0;
      for (int k = 0; k < 4; ++k) {
        if (corner[k] >= 0) continue;
        ++missing;
        without = k;
      }
      const auto add = [&](int a, int b, int c) { all.push_back({corner[a % 4], corner[b % 4], corner[c % 4]}); };
      if (missing > 1) continue;
      if (missing == 1) {
        add(without + 1, without + 2, without + 3);
        continue;
      }
      const auto seen = [&](std::size_t k) -> Eigen::Vector2d {
        return positions.row(corner[k]).head<2>().transpose();
      };
      const int from = in_circle(seen(0), seen(1), seen(2), seen(3)) > 0.0 ? 1 : 0;
      add(from, from + 1, from + 2);
      add(from, from + 2, from + 3);
    }
  }
  Triangles triangles(all.size(), 3);
  for (std::size_t t = 0; t < all.size(); ++t) triangles.row(t) << all[t][0], all[t][1], all[t][2];
  return triangles;
}

}  // namespace tacipc
