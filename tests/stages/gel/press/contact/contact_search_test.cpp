// The broad phase against all pairs there are.
#include "stages/gel/press/contact/contact_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "stages/gel/press/solve/local_patch.h"
#include "tests/stages/gel/press/contact/search_scene.h"

namespace tacipc {
namespace contact_search_test {

constexpr double kRadius = 0.3e-3;

/// Moves object and gel about, in steps small and large, and counts pairs that come near in between; all of them must
/// have been found.
int expect_finds_all(SearchScene& scene, ContactSearch& search, const auto& way_of_call) {
  const std::vector<ContactPair> all = all_pairs(scene.mesh);
  int near = 0;
  for (int call = 0; call < 24; ++call) {
    const Positions p = way_of_call(call);
    const std::vector<ContactPair> found = sorted(search.pairs(scene.x, p, kRadius), scene.mesh.num_gel_vertices);
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end(), same) == found.end()) << "a pair counts twice";
    EXPECT_LT(found.size(), all.size() / 2);
    for (const ContactPair& pair : all) {
      if (nearest_on_the_way(pair, scene.x, p) >= reach(scene.mesh, pair, kRadius)) continue;
      ++near;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), sorted({pair}, scene.mesh.num_gel_vertices)[0], less))
          << "call " << call;
    }
    scene.x += p;
  }
  return near;
}

/// Where d̂ is large, pairs of the gel count within half of their distance at rest, which differs from each to the next.
TEST(ContactSearch, FindsEveryPairOfTheGelWithinAReachOfItsOwn) {
  constexpr double kLarge = 3e-3;
  SearchScene scene;
  ContactSearch search(scene.mesh);
  const std::vector<ContactPair> all = all_pairs(scene.mesh);
  int near = 0;
  for (int call = 0; call < 3; ++call) {
    const Positions p = scene.displacement(call == 1 ? 0.02e-3 : 0.5e-3);
    const std::vector<ContactPair> found = sorted(search.pairs(scene.x, p, kLarge), scene.mesh.num_gel_vertices);
    for (const ContactPair& pair : all) {
      if (nearest_on_the_way(pair, scene.x, p) >= reach(scene.mesh, pair, kLarge)) continue;
      ++near;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), sorted({pair}, scene.mesh.num_gel_vertices)[0], less))
          << "call " << call;
    }
    scene.x += p;
  }
  EXPECT_GT(near, 1000);
}

TEST(ContactSearch, FindsEveryPairThatComesNearOnTheWay) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  // Mostly small steps, now and then one beyond the room.
  const int near =
      expect_finds_all(scene, search, [&](int call) { return scene.displacement(call % 8 == 7 ? 0.3e-3 : 4e-6); });
  EXPECT_GT(near, 1000);
  EXPECT_LT(search.with_itself().num_searches(), 12);
}

/// The face is farther from the sides than it goes from call to call, until some of it comes near one of them.
TEST(ContactSearch, FindsEveryPairOfTheFaceWithASideThatItMovesTo) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  const Positions rest = scene.x;
  const int near = expect_finds_all(scene, search, [&](int call) {
    Positions p = scene.displacement(2e-6);
    for (int v = 0; v < scene.mesh.num_gel_vertices; ++v) {
      if (std::abs(rest(v, 2)) < 1e-9 && std::abs(rest(v, 0) - 2e-3) < 1e-9)
        p(v, 0) += call % 12 < 6 ? 0.14e-3 : -0.14e-3;
    }
    return p;
  });
  EXPECT_GT(near, 100);
}

TEST(ContactSearch, FindsThemWhileTheObjectMovesAndTurnsAndDragsTheGelAlong) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  const int near = expect_finds_all(scene, search, [&](int call) {
    Positions p = scene.displacement(1e-6);
    p.col(0).array() += 0.2e-3;  // everything, together
    const double turn = call % 3 == 0 ? 0.02 : 1e-4;
    for (Eigen::Index v = scene.mesh.num_gel_vertices; v < p.rows(); ++v) {
      p(v, 0) -= turn * scene.x(v, 1);
      p(v, 1) += turn * scene.x(v, 0);
    }
    return p;
  });
  EXPECT_GT(near, 500);
}

TEST(ContactSearch, LooksAgainOnlyAtWhatMovesRelativeToTheObject) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  const Positions still = Positions::Zero(scene.x.rows(), 3);
  const auto looks = [&](const Positions& p) {
    const std::int64_t before = search.with_object().num_searches();
    search.pairs(scene.x, p, kRadius);
    scene.x += p;
    return search.with_object().num_searches() - before;
  };
  const std::int64_t all = looks(still);
  EXPECT_EQ(all, static_cast<std::int64_t>(scene.mesh.gel.vertices.size() + scene.mesh.gel.edges.size() +
                                           scene.mesh.gel.triangles.size()));
  EXPECT_EQ(looks(still), 0);
  Positions together = still;
  together.col(0).setConstant(5e-3);
  EXPECT_EQ(looks(together), 0);
  Positions one = still;
  one(scene.mesh.gel.vertices[0], 2) = 0.5e-3;
  const std::int64_t few = looks(one);
  EXPECT_GT(few, 1);
  EXPECT_LT(few, all / 4);
  search.forget();
  EXPECT_EQ(looks(still), all);
  search.pairs(scene.x, still, 2.0 * kRadius);
  EXPECT_EQ(looks(still), all) << "another radius";
}

/// Two pieces of gel side by side make the same long step, then different parts of it back: they have never been as
/// near as then, though each is inside the box of its own path.
TEST(ContactSearch, FindsWhatComesNearOnTheWayBack) {
  const Positions one{{0, 0, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, -1e-3}};
  Positions rest(8, 3);
  rest << one, one;
  rest.bottomRows(4).col(0).array() += 2e-3;
  const Tetrahedra tets{{0, 2, 1, 3}, {4, 6, 5, 7}};
  const ContactMesh mesh = make_contact_mesh(rest, boundary_triangles(tets, 8), {});
  ContactSearch search(mesh);
  Positions x = rest, p = Positions::Zero(8, 3);
  p.rowwise() = Eigen::RowVector3d(3e-3, 3e-3, 0);
  search.pairs(x, p, kRadius);
  x += p;
  p.topRows(4).rowwise() = Eigen::RowVector3d(0, -2.5e-3, 0);
  p.bottomRows(4).rowwise() = Eigen::RowVector3d(-0.9e-3, -2.5e-3, 0);
  const std::vector<ContactPair> found = search.pairs(x, p, kRadius);
  x += p;
  int near = 0;
  for (const ContactPair& pair : all_pairs(mesh)) {
    if (std::sqrt(closest_feature(pair, gather(x, pair)).squared_distance) >= reach(mesh, pair, kRadius)) continue;
    ++near;
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const ContactPair& other) {
      return same(sorted({pair}, 8)[0], sorted({other}, 8)[0]);
    }));
  }
  EXPECT_GT(near, 0);
}

/// Those that may move.
std::vector<char> marked(const std::vector<double>& reach_m) {
  std::vector<char> marks;
  for (const double reach : reach_m) marks.push_back(reach > 0.0);
  return marks;
}

TEST(ContactSearch, AroundMovingVerticesNoNearPairIsMissed) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  const Positions p = scene.displacement(20e-6);
  Positions start = scene.x + p;

  // The vertices under the tip move, each as far as it may: some much farther than the room that searches leave. All of
  // them have gone half as far before.
  std::vector<bool> moves(static_cast<std::size_t>(scene.x.rows()), false);
  std::vector<double> far_m(moves.size(), 0.0), reach_m = far_m;
  for (int v = 0; v < scene.mesh.num_gel_vertices; ++v) {
    moves[v] = scene.x(v, 2) > -1e-9 && scene.x.row(v).head<2>().norm() < 1.2e-3;
    if (moves[v]) far_m[v] = v % 3 == 0 ? 0.2e-3 : 1.2e-3;
    reach_m[v] = 1.5 * far_m[v];
  }
  ASSERT_GT(std::count(moves.begin(), moves.end(), true), 3);
  // Each in a direction of its own, by a part of how far it may go.
  const auto go = [&](Positions& x, double part) {
    const Positions directions = scene.displacement(1.0).cwiseSign() / std::sqrt(3.0);
    for (Eigen::Index v = 0; v < x.rows(); ++v)
      x.row(v) += part * far_m[static_cast<std::size_t>(v)] * directions.row(v);
  };
  const std::vector<ContactPair> all = all_pairs(scene.mesh);
  std::vector<ContactPair> before = search.pairs(scene.x, p, kRadius);
  int near = 0;
  // From there once more, and once more after all vertices have gone somewhere.
  for (int round = 0; round < 3; ++round) {
    if (round == 2) {
      start += scene.displacement(0.2e-3);
      before = search.pairs(start, Positions::Zero(start.rows(), 3), kRadius);
    }
    go(start, 0.5);
    // All of them, or only some of those that go less far: the others move all the same.
    std::vector<char> wanted(moves.size(), 0);
    for (std::size_t v = 0; v < moves.size(); ++v) wanted[v] = moves[v] && (round != 1 || v % 3 == 0);
    std::vector<ContactPair> around = search.pairs_around(wanted, reach_m, start, kRadius);
    std::vector<ContactPair> with_others = with_patch(before, moves, around);
    with_others = sorted(std::move(with_others), scene.mesh.num_gel_vertices);
    EXPECT_TRUE(std::adjacent_find(with_others.begin(), with_others.end(), same) == with_others.end());
    around = sorted(std::move(around), scene.mesh.num_gel_vertices);
    EXPECT_TRUE(std::adjacent_find(around.begin(), around.end(), same) == around.end()) << "a pair counts twice";
    for (int trial = 0; trial < 10; ++trial) {
      Positions moved = start;
      go(moved, 1.0);
      for (const ContactPair& pair : all) {
        const auto& v = pair.vertices;
        const double within = reach(scene.mesh, pair, kRadius);
        if (closest_feature(pair, gather(moved, pair)).squared_distance >= within * within) continue;
        const ContactPair as_sorted = sorted({pair}, scene.mesh.num_gel_vertices)[0];
        const auto one_of = [&](const auto& marked) {
          return marked[v[0]] || marked[v[1]] || marked[v[2]] || marked[v[3]];
        };
        if (!one_of(moves) || one_of(wanted)) {
          EXPECT_TRUE(std::binary_search(with_others.begin(), with_others.end(), as_sorted, less)) << round;
        }
        if (!one_of(wanted)) continue;
        ++near;
        EXPECT_TRUE(std::binary_search(around.begin(), around.end(), as_sorted, less)) << round;
      }
    }
  }
  EXPECT_GT(near, 300);
}

TEST(ContactSearch, AroundAVertexOfAGelThatHasBeenDraggedItsPairsAreFound) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  Eigen::Index a = 0;
  scene.x.topRows(scene.mesh.num_gel_vertices).rowwise().norm().minCoeff(&a);
  std::vector<double> reach_m(static_cast<std::size_t>(scene.x.rows()), 0.0);
  reach_m[static_cast<std::size_t>(a)] = 0.01e-3;
  constexpr double kSmall = 0.1e-3;
  const Positions still = Positions::Zero(scene.x.rows(), 3);
  int near = 0;
  for (const double dragged : {0.0, 0.15}) {  // by that part of the distance from the rim
    scene.x = scene.mesh.rest_positions;
    scene.mesh.object_rows(scene.x).col(2).array() += 1e-3;
    for (int v = 0; v < scene.mesh.num_gel_vertices; ++v) {
      const auto at_rest = scene.mesh.rest_positions.row(v);
      if (std::abs(at_rest.z()) < 1e-9) scene.x(v, 0) += dragged * (3e-3 - at_rest.head<2>().cwiseAbs().maxCoeff());
    }
    scene.x(a, 0) = -0.65e-3;  // near the next vertex once that has been dragged to −0.7 mm
    search.pairs(scene.x, still, kSmall);
    const std::vector<ContactPair> around =
        sorted(search.pairs_around(marked(reach_m), reach_m, scene.x, kSmall), scene.mesh.num_gel_vertices);
    for (const ContactPair& pair : all_pairs(scene.mesh)) {
      const auto& v = pair.vertices;
      const double within = reach(scene.mesh, pair, kSmall);
      if (std::find(v.begin(), v.end(), a) == v.end() ||
          closest_feature(pair, gather(scene.x, pair)).squared_distance >= within * within)
        continue;
      ++near;
      EXPECT_TRUE(
          std::binary_search(around.begin(), around.end(), sorted({pair}, scene.mesh.num_gel_vertices)[0], less))
          << dragged;
    }
  }
  EXPECT_GT(near, 3);
}

TEST(ContactSearch, AroundTwoVerticesThatMeetHalfwayTheirPairsAreFound) {
  SearchScene scene;
  ContactSearch search(scene.mesh);
  search.pairs(scene.x, Positions::Zero(scene.x.rows(), 3), kRadius);
  // Neighbours on the front, 1 mm apart: neither could come near the other by itself.
  const auto vertex_at = [&](double x) {
    Eigen::Index v = 0;
    (scene.x.topRows(scene.mesh.num_gel_vertices).rowwise() - Eigen::RowVector3d(x, 0, 0))
        .rowwise()
        .norm()
        .minCoeff(&v);
    return v;
  };
  const Eigen::Index a = vertex_at(0.0), b = vertex_at(1e-3);
  ASSERT_NEAR((scene.x.row(b) - scene.x.row(a)).norm(), 1e-3, 1e-9);
  const double far_m = 0.4e-3;
  std::vector<double> reach_m(static_cast<std::size_t>(scene.x.rows()), 0.0);
  reach_m[static_cast<std::size_t>(a)] = reach_m[static_cast<std::size_t>(b)] = far_m;
  const std::vector<ContactPair> around =
      sorted(search.pairs_around(marked(reach_m), reach_m, scene.x, kRadius), scene.mesh.num_gel_vertices);
  Positions moved = scene.x;
  moved(a, 0) += far_m;
  moved(b, 0) -= far_m;
  int met = 0;
  for (const ContactPair& pair : all_pairs(scene.mesh)) {
    const auto& v = pair.vertices;
    const auto has = [&](Eigen::Index vertex) { return std::find(v.begin(), v.end(), vertex) != v.end(); };
    const double within = reach(scene.mesh, pair, kRadius);
    if (!has(a) || !has(b) || closest_feature(pair, gather(moved, pair)).squared_distance >= within * within) continue;
    ++met;
    EXPECT_TRUE(std::binary_search(around.begin(), around.end(), sorted({pair}, scene.mesh.num_gel_vertices)[0], less));
  }
  EXPECT_GT(met, 5);
}

}  // namespace contact_search_test
}  // namespace tacipc
