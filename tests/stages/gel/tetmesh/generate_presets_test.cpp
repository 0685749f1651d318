// The shipped meshes of the paper: sizes and edge lengths.
#include <gtest/gtest.h>

#include "stages/gel/tetmesh/generate.h"
#include "tests/stages/gel/tetmesh/gels.h"

namespace tacipc {
namespace generate_presets_test {

TEST(Presets, Adaptive100HasThePapersSize) {
  const GenerateConfig config = preset("adaptive_0100um");
  const TetMesh mesh = generate_gel(mctac_gel(), config);
  // The paper: 23,661 vertices, 104,675 tets; the tolerance asked for is 15 %, the fit is to 2 %.
  EXPECT_NEAR(static_cast<double>(mesh.num_vertices()), 23661.0, 0.03 * 23661.0);
  EXPECT_NEAR(static_cast<double>(mesh.num_tets()), 104675.0, 0.03 * 104675.0);
  expect_wanted_edges(mesh, mctac_gel(), config, 0.05, 50);
  const GelEdges edges = edge_statistics(mesh, 0.015, {});
  EXPECT_NEAR(edges.front_centre.mean_m, 1.0e-4, 0.05e-4);
  EXPECT_NEAR(edges.back.mean_m, 1.0e-3, 0.05e-3);
}

TEST(Presets, Adaptive250HasThePapersEdgeLengths) {
  const GenerateConfig config = preset("adaptive_0250um");
  const TetMesh mesh = generate_gel(mctac_gel(), config);
  expect_wanted_edges(mesh, mctac_gel(), config, 0.05, 50);
  const GelEdges edges = edge_statistics(mesh, 0.015, {});
  EXPECT_NEAR(edges.front_centre.mean_m, 2.5e-4, 0.1e-4);
  EXPECT_NEAR(edges.back.mean_m, 1.0e-3, 0.05e-3);
}

TEST(Presets, Uniform500IsUniform) {
  const GenerateConfig config = preset("uniform_0500um");
  const TetMesh mesh = generate_gel(mctac_gel(), config);
  expect_wanted_edges(mesh, mctac_gel(), config, 0.05, 50);
}

}  // namespace generate_presets_test
}  // namespace tacipc
