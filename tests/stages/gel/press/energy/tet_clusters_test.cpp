// Patches of tetrahedra, and the element that shares its volume over them.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "stages/gel/press/energy/averaged_elasticity.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/element.h"
#include "tests/stages/gel/press/elastic_block.h"

namespace tacipc {
namespace tet_clusters_test {

bool share_face(const Tetrahedra& tets, int a, int b) {
  int shared = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) shared += tets(a, i) == tets(b, j);
  }
  return shared == 3;
}

TEST(TetClusters, EachTetrahedronInOneConnectedClusterOfAboutTheSizeAskedFor) {
  const Block block = make_block({3, 2, 1}, {6, 5, 4}, 0.2);
  for (const int size : {1, 4, 12, 30}) {
    const TetClusters clusters = make_tet_clusters(block.tets, size);
    std::vector<int> seen(static_cast<std::size_t>(block.tets.rows()), 0);
    for (const auto& cluster : clusters) {
      EXPECT_GE(2 * static_cast<int>(cluster.size()), size);
      EXPECT_LT(2 * static_cast<int>(cluster.size()), 3 * size + 1);
      for (const int t : cluster) ++seen[t];
      std::vector<int> reached{cluster[0]};
      for (std::size_t at = 0; at < reached.size(); ++at) {
        for (const int t : cluster) {
          if (share_face(block.tets, reached[at], t) && std::find(reached.begin(), reached.end(), t) == reached.end())
            reached.push_back(t);
        }
      }
      EXPECT_EQ(reached.size(), cluster.size());
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), block.tets.rows());
    EXPECT_EQ(clusters, make_tet_clusters(block.tets, size));
  }
}

/// Twelve tetrahedra about a vertex have 12 vertices or a few more, in a row they have 15; most of a cluster is about
/// one vertex, at least half of it everywhere.
TEST(TetClusters, LieAboutAVertex) {
  const Block block = make_block({3, 2, 1}, {6, 5, 4}, 0.2);
  double share = 0.0;
  const TetClusters clusters = make_tet_clusters(block.tets, kClusterSize);
  for (const auto& cluster : clusters) {
    std::map<int, int> uses;
    for (const int t : cluster) {
      for (int k = 0; k < 4; ++k) ++uses[block.tets(t, k)];
    }
    int most = 0;
    for (const auto& [vertex, count] : uses) most = std::max(most, count);
    EXPECT_LE(uses.size(), cluster.size() + 2);
    EXPECT_GE(2 * most, static_cast<int>(cluster.size()));
    share += static_cast<double>(most) / static_cast<double>(cluster.size());
  }
  EXPECT_GT(share / static_cast<double>(clusters.size()), 0.8);
}

TEST(TetClusters, ATinyPartOfAMeshIsAClusterAndNoMeshIsNone) {
  EXPECT_EQ(make_tet_clusters(Tetrahedra{{0, 1, 2, 3}, {4, 5, 6, 7}}, 12), (TetClusters{{0}, {1}}));
  EXPECT_TRUE(make_tet_clusters(Tetrahedra(0, 4), 12).empty());
}

}  // namespace tet_clusters_test
}  // namespace tacipc
