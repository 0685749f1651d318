// The broad phase that is kept against a new one, and against all pairs.
#include "stages/press/contact/contact_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/press/small_scene.h"

namespace tacipc {
namespace {

constexpr double kRadius = 0.3e-3;

bool same(const ContactPair& a, const ContactPair& b) { return a.kind == b.kind && a.vertices == b.vertices; }

/// A block of gel under a pyramid whose tip is in reach.
struct Scene {
  TetMesh gel = block_gel(6, 0.006, 0.002);
  TriangleMesh object = pyramid(0.003, 0.002);
  ContactMesh mesh;
  Positions x;
  std::mt19937 random{7};

  Scene() {
    object.positions.col(2).array() += 0.1e-3 - object.positions.col(2).minCoeff();
    mesh = make_contact_mesh(gel.positions, boundary_triangles(gel.tets, gel.positions.rows()), object.positions,
                             object.triangles);
    x = mesh.rest_positions;
  }
  Positions way(double largest) {
    std::uniform_real_distribution<double> uniform(-largest, largest);
    Positions p(x.rows(), 3);
    for (double& c : p.reshaped()) c = uniform(random);
    return p;
  }
};

TEST(ContactSearch, WhatIsKeptGivesWhatANewSearchFinds) {
  Scene scene;
  ContactSearch kept(scene.mesh);
  const int calls = 40;
  for (int i = 0; i < calls; ++i) {
    // Mostly small steps, now and then one beyond the room.
    const Positions p = scene.way(i % 10 == 9 ? 0.2e-3 : 2e-6);
    const std::vector<ContactPair> found = kept.pairs(scene.x, p, kRadius);
    const std::vector<ContactPair> anew = ContactSearch(scene.mesh).pairs(scene.x, p, kRadius);
    ASSERT_GT(found.size(), 100u);
    ASSERT_TRUE(std::equal(found.begin(), found.end(), anew.begin(), anew.end(), same)) << "call " << i;
    scene.x += p;
  }
  EXPECT_GE(kept.num_searches(), calls / 10);
  EXPECT_LT(kept.num_searches(), calls / 2);
}

TEST(ContactSearch, ForgettingOrAnotherRadiusSearchesAnew) {
  Scene scene;
  ContactSearch search(scene.mesh);
  const Positions still = Positions::Zero(scene.x.rows(), 3);
  search.pairs(scene.x, still, kRadius);
  search.pairs(scene.x, still, kRadius);
  EXPECT_EQ(search.num_searches(), 1);
  search.pairs(scene.x, still, 2.0 * kRadius);
  EXPECT_EQ(search.num_searches(), 2);
  search.forget();
  search.pairs(scene.x, still, 2.0 * kRadius);
  EXPECT_EQ(search.num_searches(), 3);
}

TEST(ContactSearch, AroundMovingVerticesNoNearPairIsMissed) {
  Scene scene;
  ContactSearch search(scene.mesh);
  const Positions p = scene.way(20e-6);
  search.pairs(scene.x, p, kRadius);
  const Positions start = scene.x + p;  // where the call saw them come by

  // The vertices under the tip move, each as far as it may: much farther than the room that searches leave.
  const double reach = 0.9e-3;
  std::vector<bool> moves(static_cast<std::size_t>(scene.x.rows()), false);
  for (int v = 0; v < scene.mesh.num_gel_vertices; ++v)
    moves[v] = scene.x(v, 2) > -1e-9 && scene.x.row(v).head<2>().norm() < 1.2e-3;
  ASSERT_GT(std::count(moves.begin(), moves.end(), true), 3);
  std::vector<ContactPair> around = search.pairs_around(moves, start, kRadius, reach);
  const auto less = [](const ContactPair& a, const ContactPair& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.vertices < b.vertices;
  };
  // An edge pair of two gel edges counts whichever comes first.
  for (ContactPair& pair : around) {
    auto& v = pair.vertices;
    if (pair.kind == ContactPair::Kind::edge_edge && std::pair(v[2], v[3]) < std::pair(v[0], v[1])) {
      std::swap(v[0], v[2]);
      std::swap(v[1], v[3]);
    }
  }
  std::sort(around.begin(), around.end(), less);
  EXPECT_TRUE(std::adjacent_find(around.begin(), around.end(), same) == around.end()) << "a pair counts twice";
  int near = 0;
  for (int trial = 0; trial < 20; ++trial) {
    Positions moved = start;
    const Positions far = reach * scene.way(1.0).cwiseSign();
    for (Eigen::Index v = 0; v < moved.rows(); ++v) {
      if (moves[v]) moved.row(v) += far.row(v);
    }
    for (const ContactPair& pair : ContactSearch(scene.mesh).pairs(moved, Positions::Zero(moved.rows(), 3), kRadius)) {
      const auto& v = pair.vertices;
      if (!(moves[v[0]] || moves[v[1]] || moves[v[2]] || moves[v[3]])) continue;
      if (closest_feature(pair, gather(moved, pair)).squared_distance >= kRadius * kRadius) continue;
      ++near;
      EXPECT_TRUE(std::binary_search(around.begin(), around.end(), pair, less));
    }
  }
  EXPECT_GT(near, 200);
}

}  // namespace
}  // namespace tacipc
