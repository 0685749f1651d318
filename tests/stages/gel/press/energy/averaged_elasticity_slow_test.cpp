// The table of docs/elements.md: how stiff each element is against a closed form or the refined answer.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "stages/gel/press/energy/averaged_elasticity.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/element.h"
#include "tests/stages/gel/press/elastic_block.h"

namespace tacipc {
namespace averaged_elasticity_slow_test {

using Displacement = std::array<std::optional<double>, 3>;

/// Young's modulus 1 Pa; a cluster size of one is the linear element.
std::shared_ptr<const EnergyTerm> element(const Block& block, double poissons_ratio, int cluster_size) {
  const NeoHookean law{1.0 / (2.0 * (1.0 + poissons_ratio)),
                       poissons_ratio / ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio))};
  if (cluster_size == 1) return std::make_shared<Elasticity>(block.rest, block.tets, law);
  return std::make_shared<AveragedElasticity>(block.rest, block.tets, law, make_tet_clusters(block.tets, cluster_size));
}

/// Pure bending of a bar 5 × 1 × 1: energy over beam theory's E I κ² L/2. St. Venant's solution is exact where the ends
/// are prescribed along the bar only.
double bending(double poissons_ratio, int cluster_size, int cells) {
  const double kappa = 1e-3, length = 5.0;
  const Block bar = make_block({length, 1, 1}, {5 * cells, cells, cells}, 0.2);
  const auto ends = [&](const Vector3& r) {
    Displacement u;
    if (r.x() == 0.0) u[0] = 0.0;
    if (r.x() == length) u[0] = -length * kappa * (r.z() - 0.5);
    if (r.x() == 0.0 && r.y() == 0.0 && r.z() == 0.0) u[1] = u[2] = 0.0;
    if (r.x() == 0.0 && r.y() == 1.0 && r.z() == 0.0) u[2] = 0.0;
    return u;
  };
  const Equilibrium result = equilibrium(bar.rest, *element(bar, poissons_ratio, cluster_size), ends, 1e-9);
  EXPECT_TRUE(result.converged);
  return result.energy / (0.5 / 12.0 * kappa * kappa * length);
}

/// A layer 4 × 4 × 1, glued below; a plate glued to it over |x|, |y| ≤ half_width goes down by 1e-3. Force per depth
/// (N/m at E = 1 Pa) of a quarter, the other three by symmetry.
double plate_stiffness(double poissons_ratio, int cluster_size, int cells, double half_width) {
  const double depth = 1e-3;
  const Block layer = make_block({2, 2, 1}, {2 * cells, 2 * cells, cells}, 0.2);
  const auto plates = [&](const Vector3& r) -> Displacement {
    if (r.z() == 0.0) return {0.0, 0.0, 0.0};
    if (r.z() == 1.0 && r.x() < half_width + 1e-9 && r.y() < half_width + 1e-9) return {0.0, 0.0, -depth};
    Displacement u;
    if (r.x() == 0.0) u[0] = 0.0;
    if (r.y() == 0.0) u[1] = 0.0;
    return u;
  };
  const Equilibrium result = equilibrium(layer.rest, *element(layer, poissons_ratio, cluster_size), plates, 1e-9);
  EXPECT_TRUE(result.converged);
  double force = 0.0;  // of the layer on what holds the plate
  for (Eigen::Index v = 0; v < layer.rest.rows(); ++v) {
    const Vector3 r = layer.rest.row(v);
    if (r.z() == 1.0 && r.x() < half_width + 1e-9 && r.y() < half_width + 1e-9) force += result.force(v, 2);
  }
  return 4.0 * force / depth;
}

struct Row {
  std::string name;
  std::function<double(double poissons_ratio, int cluster_size, int cells)> measure;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all{
      {"bar in pure bending", bending},
      {"layer under a plate of its own size",
       [](double nu, int size, int cells) { return plate_stiffness(nu, size, cells, 2.0); }},
      {"layer under a punch a quarter as wide",
       [](double nu, int size, int cells) { return plate_stiffness(nu, size, cells, 0.5); }}};
  return all;
}

TEST(Elements, TableOfLinearAndAveragedVolume) {
  fmt::print(
      "| case | nu | linear: 2 cells | 4 | 8 | averaged_volume: 2 cells | 4 | 8 "
      "|\n|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows()) {
    for (const double nu : {0.3, 0.45, 0.475, 0.4999}) {
      double linear[3], averaged[3];
      for (int k = 0; k < 3; ++k) {
        linear[k] = row.measure(nu, 1, 2 << k);
        averaged[k] = row.measure(nu, kClusterSize, 2 << k);
      }
      fmt::print("| {} | {} | {:.4g} | {:.4g} | {:.4g} | {:.4g} | {:.4g} | {:.4g} |\n", row.name, nu, linear[0],
                 linear[1], linear[2], averaged[0], averaged[1], averaged[2]);
      // Averaging only takes energy away; and where the answer is known its error falls with the mesh as it should.
      for (int k = 0; k < 3; ++k) EXPECT_LE(averaged[k], 1.0001 * linear[k]) << row.name << " " << nu;
      if (row.name == "bar in pure bending") {
        EXPECT_LT(averaged[2] - 1.0, 0.06) << nu;  // exact: 1
        EXPECT_LT(averaged[2] - 1.0, 0.4 * (averaged[1] - 1.0)) << nu;
      }
      if (nu == 0.4999) {
        EXPECT_GT(linear[2], 3.0 * averaged[2]) << row.name;
      }
    }
  }
}

TEST(Elements, TableOfPatchSizes) {
  fmt::print("| case, nu 0.4999, 4 and 8 cells |");
  const std::vector<int> sizes{4, 6, 8, 12, 16, 24};
  for (const int size : sizes) fmt::print(" {} |", size);
  fmt::print("\n|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows()) {
    for (const int cells : {4, 8}) {
      fmt::print("| {}, {} |", row.name, cells);
      double last = std::numeric_limits<double>::infinity();
      for (const int size : sizes) {
        const double value = row.measure(0.4999, size, cells);
        fmt::print(" {:.4g} |", value);
        EXPECT_LT(value, 1.03 * last) << row.name << ", clusters of " << size;
        last = value;
      }
      fmt::print("\n");
    }
  }
}

}  // namespace averaged_elasticity_slow_test
}  // namespace tacipc
