// Pairs of a patch's vertices against all pairs there are.
#include "stages/gel/press/contact/patch_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/stages/gel/press/contact/search_scene.h"

namespace tacipc {
namespace patch_search_test {

constexpr double kRadius = 0.3e-3;

TEST(PatchSearch, AVertexSearchedAgainHasItsNewPairsHoweverShortItsNextWay) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  const Positions still = Positions::Zero(scene.x.rows(), 3);
  search.pairs(scene.x, still, kRadius);
  Eigen::Index a = 0;
  scene.x.topRows(scene.mesh.num_gel_vertices).rowwise().norm().minCoeff(&a);
  const auto by = [&](double way_m) {
    Positions step = still;
    step(a, 0) = way_m;
    return step;
  };
  const std::vector<int> vertices{static_cast<int>(a)};
  PatchSearch patch(search, vertices, scene.mesh.num_gel_vertices, scene.x, by(0.05e-3), kRadius, 0.4e-3);
  Positions x = scene.x + by(0.1e-3);
  ASSERT_EQ(patch.part_within_reach(scene.x, by(0.1e-3)), 1.0);
  EXPECT_TRUE(patch.extend_to(x));
  EXPECT_FALSE(patch.extend_to(x + by(0.02e-3)));          // no farther than what was spared
  ASSERT_EQ(patch.part_within_reach(x, by(0.1e-3)), 1.0);  // beyond three times the first step: searched again
  EXPECT_TRUE(patch.extend_to(x + by(0.02e-3)));
}

/// Vertices crowd together step by step, on ways much longer than any one search is for.
TEST(PatchSearch, HasEveryNearPairOnItsWays) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  const Positions p = scene.displacement(20e-6);
  search.pairs(scene.x, p, kRadius);
  Positions x = scene.x + p;
  std::vector<int> vertices;
  std::vector<bool> moves(static_cast<std::size_t>(x.rows()), false);
  for (int v = 0; v < scene.mesh.num_gel_vertices; ++v) {
    if (x(v, 2) > -1.1e-3 && x.row(v).head<2>().norm() < 2.3e-3) vertices.push_back(v);
  }
  ASSERT_GT(vertices.size(), 20u);
  Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
  for (const int v : vertices) {
    moves[v] = true;
    middle += x.row(v) / static_cast<double>(vertices.size());
  }
  const auto step_from = [&](const Positions& at) {
    Positions step = Positions::Zero(at.rows(), 3);
    const Positions aside = scene.displacement(0.05e-3);
    for (const int v : vertices) {
      step.row(v) = aside.row(v);
      if (v % 3 == 0) {
        step.row(v) *= 0.02;  // hardly moves
      } else {
        step.row(v) += 0.4 * (middle - at.row(v));
      }
    }
    return step;
  };
  const std::vector<ContactPair> all = all_pairs(scene.mesh);
  const auto with_vertices =
      static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const ContactPair& pair) {
        return std::any_of(pair.vertices.begin(), pair.vertices.end(), [&](int v) { return moves[v]; });
      }));
  Positions step = step_from(x);
  PatchSearch patch(search, vertices, scene.mesh.num_gel_vertices, x, step, kRadius, 0.1e-3);
  int of_gel = 0, of_object = 0, cut = 0;
  std::size_t most = 0;
  for (int k = 0; k < 40; ++k, step = step_from(x)) {
    const double part = patch.part_within_reach(x, step);
    ASSERT_GT(part, 0.0);
    cut += part < 1.0;
    step *= part;
    patch.extend_to(x + step);
    const std::vector<ContactPair> found = sorted(patch.pairs(), scene.mesh.num_gel_vertices);
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end(), same) == found.end()) << "a pair counts twice";
    most = std::max(most, found.size());
    for (const ContactPair& pair : all) {
      const auto& v = pair.vertices;
      if (!(moves[v[0]] || moves[v[1]] || moves[v[2]] || moves[v[3]])) continue;
      if (nearest_on_the_way(pair, x, step) >= reach(scene.mesh, pair, kRadius)) continue;
      ++(*std::max_element(v.begin(), v.end()) < scene.mesh.num_gel_vertices ? of_gel : of_object);
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), sorted({pair}, scene.mesh.num_gel_vertices)[0], less));
    }
    x += step;
    EXPECT_FALSE(patch.extend_to(x)) << "it has just been there";
  }
  EXPECT_GT(of_gel, 500);
  EXPECT_GT(of_object, 200);
  EXPECT_GT(cut, 5);
  EXPECT_LT(most, with_vertices / 2) << "not all that there is";
}

}  // namespace patch_search_test
}  // namespace tacipc
