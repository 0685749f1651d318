#include "verification/stress_gel.h"

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "stages/gel/press/measure/front_surface.h"
#include "verification/gel_shapes.h"

namespace tacipc::verify {
namespace {

double volume6(const Positions& x, const auto& tet) {
  Matrix3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = x.row(tet[k + 1]) - x.row(tet[0]);
  return edges.determinant();
}

/// Vertices that box_mesh makes of a box.
double count_of(const BoxGel& box) {
  const auto lines = [&](double size) {
    return static_cast<double>(
        graded_lines(size / 2, box.near_m, box.near_half_m, box.growth, box.far_m, std::nullopt).size());
  };
  double layers = 1.0, covered = 0.0;
  for (double step = box.layer_m; covered < box.thickness_m; step *= box.layer_growth, ++layers) covered += step;
  return lines(box.width_m) * lines(box.height_m) * layers;
}

GelSpec draw_box(const StressConfig::Gel& ranges, double thickness_m, double vertices, Draws& draws) {
  BoxGel box;
  box.thickness_m = thickness_m;
  box.width_m = thickness_m * draws.in(ranges.width_thicknesses);
  box.height_m = thickness_m * draws.in(ranges.width_thicknesses);
  box.growth = draws.in(ranges.growth);
  box.layer_growth = draws.in(ranges.growth);
  box.near_half_m = 0.25 * draws.unit() * std::min(box.width_m, box.height_m);
  const double flatness = draws.in({0.5, 1.0});  // first layer over cell width
  for (double cell = thickness_m;; cell *= 0.98) {
    box.near_m = cell;
    box.far_m = std::max(cell, 0.5 * thickness_m);
    box.layer_m = flatness * cell;
    if (count_of(box) >= vertices) break;
  }
  return {.shape = box};
}

GelSpec draw_disc(const StressConfig::Gel& ranges, double thickness_m, double vertices, Draws& draws) {
  DiscGel disc;
  disc.thickness_m = thickness_m;
  disc.radius_m = 0.5 * thickness_m * draws.in(ranges.width_thicknesses);
  const double growth = draws.in(ranges.growth), back = draws.in(ranges.growth), part = draws.in({0.1, 0.4});
  GelShape shape;
  shape.outline = GelShape::Outline::disc;
  shape.radius_m = disc.radius_m;
  shape.thickness_m = thickness_m;
  for (double edge = thickness_m;; edge *= 0.98) {
    disc.sizing = {.centre_m = edge,
                   .centre_radius_m = part * disc.radius_m,
                   .inner_m = growth * edge,
                   .inner_radius_m = (part + 0.4) * disc.radius_m,
                   .rim_m = growth * growth * edge,
                   .back_m = back * edge};
    if (estimated_vertices(sizing_for(disc.sizing, shape)) >= vertices) break;
  }
  return {.shape = disc};
}

}  // namespace

StressGel draw_gel(const StressConfig::Gel& ranges, double exact_share, Draws& draws) {
  const bool round = draws.chance(ranges.disc_share);
  const double thickness_m = draws.in(ranges.thickness_m), vertices = draws.in(ranges.vertices);
  const GelSpec spec =
      round ? draw_disc(ranges, thickness_m, vertices, draws) : draw_box(ranges, thickness_m, vertices, draws);
  StressGel gel;
  gel.mesh = make_gel(spec, {});
  gel.shape = shape_of(spec, gel.mesh);
  const double jitter = draws.in(ranges.jitter);
  if (!draws.chance(exact_share)) jitter_vertices(gel.mesh, jitter, draws);
  gel.front_edge_m = median_front_edge_m(gel.mesh);
  return gel;
}

void jitter_vertices(TetMesh& mesh, double part, Draws& draws) {
  const auto count = static_cast<std::size_t>(mesh.num_vertices());
  std::vector<bool> fixed(count, false), front(count, false);
  for (std::size_t f = 0; f < mesh.tags.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.boundary(static_cast<Eigen::Index>(f), k);
      (mesh.tags[f] == BoundaryTag::front ? front : fixed)[static_cast<std::size_t>(v)] = true;
    }
  }
  std::vector<std::vector<Eigen::Index>> tets_of(count);
  std::vector<double> volume(static_cast<std::size_t>(mesh.num_tets()));
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t) {
    for (int k = 0; k < 4; ++k) tets_of[static_cast<std::size_t>(mesh.tets(t, k))].push_back(t);
    volume[static_cast<std::size_t>(t)] = volume6(mesh.positions, mesh.tets.row(t));
  }
  for (std::size_t v = 0; v < count; ++v) {
    if (fixed[v]) continue;
    const auto row = static_cast<Eigen::Index>(v);
    const Vector3 before = mesh.positions.row(row);
    double shortest = std::numeric_limits<double>::infinity();
    for (const Eigen::Index t : tets_of[v]) {
      for (int k = 0; k < 4; ++k) {
        const double length = (mesh.positions.row(mesh.tets(t, k)).transpose() - before).norm();
        if (length > 0.0) shortest = std::min(shortest, length);
      }
    }
    Vector3 move;
    for (int k = 0; k < 3; ++k) move[k] = draws.in({-1.0, 1.0});
    if (front[v]) move.z() = 0.0;
    mesh.positions.row(row) = before + part * shortest * move;
    const bool flat = std::any_of(tets_of[v].begin(), tets_of[v].end(), [&](Eigen::Index t) {
      return volume6(mesh.positions, mesh.tets.row(t)) < 0.25 * volume[static_cast<std::size_t>(t)];
    });
    if (flat) mesh.positions.row(row) = before;
  }
}

}  // namespace tacipc::verify
