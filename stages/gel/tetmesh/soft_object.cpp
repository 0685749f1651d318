#include "stages/gel/tetmesh/soft_object.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/base/disjoint_sets.h"
#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/exact_predicates.h"
#include "common/mesh/triangle_tree.h"
#include "stages/gel/tetmesh/mesh_check.h"

namespace tacipc {
namespace {

/// Checks the surface. \throw DataError unless every edge is between two triangles of equal orientation
void check_closed(const TriangleMesh& surface) {
  std::vector<std::array<int, 2>> edges;
  for (Eigen::Index f = 0; f < surface.num_triangles(); ++f)
    for (int k = 0; k < 3; ++k) edges.push_back({surface.triangles(f, k), surface.triangles(f, (k + 1) % 3)});
  std::sort(edges.begin(), edges.end());
  if (const auto twice = std::adjacent_find(edges.begin(), edges.end()); twice != edges.end())
    throw DataError("more than two triangles, or two that look opposite ways, meet at the edge of vertices {} and {}",
                    (*twice)[0], (*twice)[1]);
  for (const auto& [from, to] : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), std::array<int, 2>{to, from}))
      throw DataError("the surface is open: only one triangle has the edge of vertices {} and {}", from, to);
  }
}

/// Checks the surface. \throw DataError that names two triangles that share more than their common vertices
void check_apart(const TriangleMesh& surface) {
  const TriangleTree tree(surface);
  const auto corners = [&](int f) {
    return std::array<int, 3>{surface.triangles(f, 0), surface.triangles(f, 1), surface.triangles(f, 2)};
  };
  const auto points = [&](const std::array<int, 3>& of) {
    return TrianglePoints{surface.positions.row(of[0]), surface.positions.row(of[1]), surface.positions.row(of[2])};
  };
  for (int f = 0; f < static_cast<int>(surface.num_triangles()); ++f) {
    const auto own = corners(f);
    tree.overlaps(tree.box_of(f), [&](int other) {
      const auto its = corners(other);
      if (other > f && mesh_triangles_intersect(own, points(own), its, points(its)))
        throw DataError("the surface intersects itself: its triangles {} and {} cross or lie on each other", f, other);
    });
  }
}

int num_pieces(const TriangleMesh& surface) {
  DisjointSets joined(static_cast<std::size_t>(surface.num_vertices()));
  int pieces = joined.size();
  for (Eigen::Index f = 0; f < surface.num_triangles(); ++f)
    for (int k = 0; k < 2; ++k)
      if (joined.join(surface.triangles(f, k), surface.triangles(f, k + 1))) --pieces;
  return pieces;
}

}  // namespace

TetMesh mesh_object(TriangleMesh surface, const GenerateConfig& config) {
  if (!config.sizing.uniform())
    throw UsageError("the sizing of an object has uniform_mm alone: edges are not graded as in a gel");
  remove_unreferenced_vertices(surface);
  check_closed(surface);
  if (const int pieces = num_pieces(surface); pieces > 1)
    throw DataError("the surface is in {} pieces: a soft object is one solid without cavities", pieces);
  const double volume_m3 = signed_volume(surface);
  if (!(volume_m3 > 0.0)) throw DataError("the triangles look inwards, or enclose no volume");
  check_apart(surface);
  const double edge_m = config.sizing.centre_m;
  const double estimate =
      static_cast<double>(surface.num_vertices()) + volume_m3 * std::numbers::sqrt2 / (edge_m * edge_m * edge_m);
  if (!(estimate <= config.max_vertices)) {
    throw DataError("the sizing asks for about {:.3g} vertices, more than max_vertices {:g}", estimate,
                    config.max_vertices);
  }
  log_info("the sizing asks for about {:.0f} vertices, {} of them on the surface", estimate, surface.num_vertices());
  const auto count = static_cast<std::size_t>(surface.num_triangles());
  const GelSurface faces{std::move(surface.positions), std::move(surface.triangles),
                         std::vector<BoundaryTag>(count, BoundaryTag::free)};
  return fill_and_check(
      faces, config, [&](const Vector3&) { return edge_m; },
      [&](const TetMesh& mesh) { check_body(mesh, config.min_dihedral_deg, "object"); });
}

}  // namespace tacipc
