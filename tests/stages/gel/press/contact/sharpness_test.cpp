// Sharpness of edges: of a cube, a cylinder, a groove and an open sheet.
#include "stages/gel/press/contact/sharpness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {
namespace sharpness_test {

constexpr int kOffset = 3;  // of vertex indices, as an object's are behind the gel's

std::vector<double> sharpness_of(const TriangleMesh& mesh, Surface& surface) {
  surface = make_surface(mesh.triangles, kOffset);
  Positions all = Positions::Constant(kOffset + mesh.num_vertices(), 3, std::nan(""));
  all.bottomRows(mesh.num_vertices()) = mesh.positions;
  return edge_sharpness(surface, all);
}

/// Two wings of unit length about the edge 0–1, the one level, the other turned down by θ (up, where negative).
TriangleMesh wings(double theta) {
  return {Positions{{0, 0, 0}, {0, 1, 0}, {-1, 0.3, 0}, {std::cos(theta), 0.6, -std::sin(theta)}},
          Triangles{{0, 1, 2}, {0, 3, 1}}};
}

TEST(Sharpness, IsOneMinusTheCosineOfTheBend) {
  Surface surface;
  for (const double theta : {0.0, 0.02, 0.3, 1.0, std::numbers::pi / 2, 2.5}) {
    const auto found = sharpness_of(wings(theta), surface);
    EXPECT_NEAR(found[index_of_edge(surface, kOffset + 1, kOffset)], std::min(1.0, 1.0 - std::cos(theta)), 1e-14);
  }
}

TEST(Sharpness, OfABendInwardsIsNone) {
  Surface surface;
  for (const double theta : {-0.02, -0.3, -1.5, -2.5}) {
    const auto found = sharpness_of(wings(theta), surface);
    EXPECT_EQ(found[index_of_edge(surface, kOffset, kOffset + 1)], 0.0) << theta;
  }
}

TEST(Sharpness, OfABoundaryIsFull) {
  Surface surface;
  const auto found = sharpness_of(wings(0.0), surface);
  EXPECT_EQ(found[index_of_edge(surface, kOffset, kOffset + 2)], 1.0);
  EXPECT_EQ(found[index_of_edge(surface, kOffset + 3, kOffset + 1)], 1.0);
}

/// Vertex i + 2 j + 4 k at (i, j, k).
TriangleMesh unit_cube() {
  TriangleMesh mesh;
  mesh.positions.resize(8, 3);
  for (int v = 0; v < 8; ++v) mesh.positions.row(v) << (v & 1), (v >> 1 & 1), (v >> 2);
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7,
      1, 7, 5;
  return mesh;
}

TEST(Sharpness, OfACubeIsFullAtEdgesAndNoneAcrossFaces) {
  Surface surface;
  const TriangleMesh cube = unit_cube();
  const auto found = sharpness_of(cube, surface);
  int sharp = 0;
  for (std::size_t e = 0; e < surface.edges.size(); ++e) {
    const auto [a, b] = surface.edges[e];
    const double length = (cube.positions.row(a - kOffset) - cube.positions.row(b - kOffset)).norm();
    EXPECT_NEAR(found[e], length < 1.1 ? 1.0 : 0.0, 1e-12);
    sharp += length < 1.1 ? 1 : 0;
  }
  EXPECT_EQ(sharp, 12);
}

}  // namespace sharpness_test
}  // namespace tacipc
