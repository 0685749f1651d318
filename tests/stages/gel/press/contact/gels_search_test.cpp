// Pairs of several gels, each carried by its mount, against all pairs there are.
#include "stages/gel/press/contact/gels_search.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "stages/gel/press/contact/distance.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/contact/search_scene.h"

namespace tacipc {
namespace gels_search_test {

constexpr double kRadius = 0.2e-3;

/// This reach for vertices that move.
std::vector<double> reach_m(const std::vector<bool>& moves, double farthest_m) {
  std::vector<double> reach(moves.size(), 0.0);
  for (std::size_t v = 0; v < moves.size(); ++v) {
    if (moves[v]) reach[v] = farthest_m;
  }
  return reach;
}

/// Two blocks of gel that face each other along x, as fingers do: z of the left one's frame is x of the world, z of the
/// right one's is −x.
class TwoGels : public ::testing::Test {
 protected:
  TwoGels() {
    Matrix3 left, right;
    left << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    right << 0, 0, -1, 1, 0, 0, 0, -1, 0;
    turns_ = {left, right};
    const auto n = static_cast<int>(gel_.num_vertices());
    Positions both(2 * n, 3);
    both << gel_.positions * left.transpose(), gel_.positions * right.transpose();
    both.topRows(n).col(0).array() -= 0.5 * kApart;
    both.bottomRows(n).col(0).array() += 0.5 * kApart;
    Triangles boundary(2 * gel_.boundary.rows(), 3);
    boundary << gel_.boundary, gel_.boundary.array() + n;
    mesh_ = make_contact_mesh(both, boundary, {});
    const auto alone = std::make_shared<const ContactMesh>(make_contact_mesh(gel_.positions, gel_.boundary, {}));
    const int anchor = gel_.vertices(BoundaryTag::glued).front();
    mesh_.gels = {{0, anchor, alone}, {n, anchor, alone}};
    all_ = sorted(all_pairs(mesh_.gel));
    x_ = mesh_.rest_positions;
  }

  bool of_one_gel(const ContactPair& pair) const {
    const auto n = static_cast<int>(gel_.num_vertices());
    const auto [low, high] = std::minmax_element(pair.vertices.begin(), pair.vertices.end());
    return (*low < n) == (*high < n);
  }
  /// How near a pair counts.
  double reach(const ContactPair& pair) const {
    return of_one_gel(pair) ? tacipc::reach(mesh_, pair, kRadius) : kRadius;
  }
  /// The way of everything in which the left gel goes along x by `way_m` and the right one against it.
  Positions closing(double way_m) const {
    const Eigen::Index n = gel_.num_vertices();
    Positions p = Positions::Zero(2 * n, 3);
    p.topRows(n).col(0).array() += way_m;
    p.bottomRows(n).col(0).array() -= way_m;
    return p;
  }
  Positions shaken(double largest_m) {
    std::uniform_real_distribution<double> uniform(-largest_m, largest_m);
    Positions p(x_.rows(), 3);
    for (double& c : p.reshaped()) c = uniform(random_);
    return p;
  }
  /// Numbers of pairs that count, {within one gel, across}; every one must be among those found.
  std::array<int, 2> expect_finds_all(GelsSearch& search, const Positions& p) {
    std::vector<ContactPair> pairs;
    search.pairs(x_, p, kRadius, pairs);
    const std::vector<ContactPair> found = sorted(std::move(pairs));
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end(), same) == found.end()) << "a pair counts twice";
    std::array<int, 2> near{};
    for (const ContactPair& pair : all_) {
      if (nearest_on_the_way(pair, x_, p) >= reach(pair)) continue;
      ++near[of_one_gel(pair) ? 0 : 1];
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), pair, less));
    }
    return near;
  }

  static constexpr double kApart = 3e-3;
  const TetMesh gel_ = block_gel(4, 0.004, 0.002);
  std::vector<Matrix3> turns_;
  ContactMesh mesh_;
  std::vector<ContactPair> all_;
  Positions x_;
  std::mt19937 random_{11};
};

TEST_F(TwoGels, FarApartEachHasItsOwnPairsAlone) {
  GelsSearch search(mesh_);
  search.turn(turns_);
  int near = 0;
  for (int call = 0; call < 6; ++call) {
    // Both are carried far, and deformed as they go.
    const Positions p = (shaken(call % 3 == 2 ? 0.45e-3 : 4e-6).rowwise() + Eigen::RowVector3d(1e-3, 2e-3, -1e-3));
    const auto [within, across] = expect_finds_all(search, p);
    near += within;
    EXPECT_EQ(across, 0);
    x_ += p;
  }
  EXPECT_GT(near, 50);
}

TEST_F(TwoGels, NearEachOtherPairsOfBothAreFoundToo) {
  GelsSearch search(mesh_);
  search.turn(turns_);
  std::array<int, 2> near{};
  for (const double way_m : {0.4 * kApart, 0.09 * kApart, 0.0, -0.05 * kApart}) {
    const Positions p = closing(way_m) + shaken(0.03e-3);
    const auto found = expect_finds_all(search, p);
    for (int k = 0; k < 2; ++k) near[k] += found[k];
    x_ += p;
  }
  EXPECT_GT(near[1], 300);
  // And pass each other, seen on the way only.
  x_ = mesh_.rest_positions;
  EXPECT_GT(expect_finds_all(search, closing(2.0 * kApart))[1], 300);
}

TEST_F(TwoGels, CarriedByTheirMountsTheyAreNotSearchedAgain) {
  GelsSearch search(mesh_);
  search.turn(turns_);
  const Positions away = closing(-1e-3);
  x_ += shaken(0.45e-3);
  std::vector<ContactPair> first, later;
  search.pairs(x_, Positions::Zero(x_.rows(), 3), kRadius, first);
  ASSERT_FALSE(first.empty());
  const int searches = search.num_searches();
  x_ += away;
  search.pairs(x_, away, kRadius, later);
  EXPECT_EQ(search.num_searches(), searches);
  for (const ContactPair& pair : first)
    EXPECT_TRUE(std::any_of(later.begin(), later.end(), [&](const ContactPair& other) { return same(pair, other); }));
  search.forget();
  search.pairs(x_, away, kRadius, later);
  EXPECT_GT(search.num_searches(), searches);
}

TEST_F(TwoGels, AroundMovingVerticesNoNearPairIsMissed) {
  GelsSearch search(mesh_);
  search.turn(turns_);
  x_ += closing(0.45 * kApart);
  const Positions p = shaken(20e-6);
  std::vector<ContactPair> pairs;
  search.pairs(x_, p, kRadius, pairs);
  x_ += p;
  // Vertices near the middle of both fronts move.
  std::vector<bool> moves(static_cast<std::size_t>(x_.rows()), false);
  for (Eigen::Index v = 0; v < x_.rows(); ++v)
    moves[static_cast<std::size_t>(v)] = std::abs(x_(v, 0)) < 0.4e-3 && x_.row(v).tail<2>().norm() < 1.2e-3;
  ASSERT_GT(std::count(moves.begin(), moves.end(), true), 6);
  constexpr double kFar_m = 0.9e-3;
  std::vector<ContactPair> around;
  search.around({moves.begin(), moves.end()}, reach_m(moves, kFar_m), x_, kRadius, around);
  around = sorted(std::move(around));
  EXPECT_TRUE(std::adjacent_find(around.begin(), around.end(), same) == around.end()) << "a pair counts twice";
  std::array<int, 2> near{};
  for (int trial = 0; trial < 10; ++trial) {
    const Positions far = kFar_m / std::sqrt(3.0) * shaken(1.0).cwiseSign();
    Positions moved = x_;
    for (Eigen::Index v = 0; v < moved.rows(); ++v) {
      if (moves[static_cast<std::size_t>(v)]) moved.row(v) += far.row(v);
    }
    for (const ContactPair& pair : all_) {
      const auto& v = pair.vertices;
      if (!(moves[v[0]] || moves[v[1]] || moves[v[2]] || moves[v[3]])) continue;
      const double within = reach(pair);
      if (closest_feature(pair, gather(moved, pair)).squared_distance >= within * within) continue;
      ++near[of_one_gel(pair) ? 0 : 1];
      EXPECT_TRUE(std::binary_search(around.begin(), around.end(), pair, less));
    }
  }
  EXPECT_GT(near[0], 20);
  EXPECT_GT(near[1], 200);
}

/// A mesh that names no parts is one gel, in the frame of the world.
TEST_F(TwoGels, OneGelAloneIsWhatSelfSearchFinds) {
  const ContactMesh& alone = *mesh_.gels[0].mesh;
  GelsSearch gels(alone);
  SelfSearch itself(alone);
  x_ = alone.rest_positions;
  std::size_t near = 0;
  for (int call = 0; call < 4; ++call) {
    const Positions p = shaken(call % 2 == 0 ? 0.45e-3 : 5e-6);
    std::vector<ContactPair> found, expected;
    gels.pairs(x_, p, kRadius, found);
    itself.pairs(x_, p, kRadius, expected);
    near += expected.size();
    EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same));
    x_ += p;
    std::vector<double> reach_m(static_cast<std::size_t>(x_.rows()), 0.0);
    std::vector<char> wanted(reach_m.size(), 0);
    reach_m[static_cast<std::size_t>(alone.gel.vertices[3])] = 1e-4;
    wanted[static_cast<std::size_t>(alone.gel.vertices[3])] = 1;
    found.clear();
    expected.clear();
    gels.around(wanted, reach_m, x_, kRadius, found);
    itself.around(wanted, reach_m, x_, kRadius, expected);
    EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same));
    EXPECT_EQ(gels.num_searches(), itself.num_searches());
  }
  EXPECT_GT(near, 10u);
}

/// A ball that nothing holds over a gel on its mount. It has no flat face: all of its surface is searched.
class BallOverAGel : public ::testing::Test {
 protected:
  BallOverAGel() {
    const auto n = static_cast<int>(gel_.num_vertices()), m = static_cast<int>(ball_.num_vertices());
    Positions both(n + m, 3);
    both << gel_.positions, ball_.positions.rowwise() + Eigen::RowVector3d(0, 0, 1.6e-3);
    Triangles surface(gel_.boundary.rows() + ball_.num_triangles(), 3);
    surface << gel_.boundary, ball_.triangles.array() + n;
    mesh_ = make_contact_mesh(both, surface, {});
    const auto alone = [](const Positions& rest, const Triangles& triangles) {
      return std::make_shared<const ContactMesh>(make_contact_mesh(rest, triangles, {}));
    };
    mesh_.gels = {{0, gel_.vertices(BoundaryTag::glued).front(), alone(gel_.positions, gel_.boundary)},
                  {n, -1, alone(ball_.positions, ball_.triangles)}};
    all_ = sorted(all_pairs(mesh_.gel));
    x_ = mesh_.rest_positions;
  }

  Positions shaken(double largest_m) {
    std::uniform_real_distribution<double> uniform(-largest_m, largest_m);
    Positions p(x_.rows(), 3);
    for (double& c : p.reshaped()) c = uniform(random_);
    return p;
  }
  auto ball_rows(Positions& x) const { return x.bottomRows(ball_.num_vertices()); }
  /// Turns the ball about its middle and shifts it.
  Positions rolled(Positions x, double angle, const Vector3& by_m) const {
    const Matrix3 turn = Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
    const Eigen::RowVector3d middle = ball_rows(x).colwise().mean();
    const Positions turned = (ball_rows(x).rowwise() - middle) * turn.transpose();
    ball_rows(x) = turned.rowwise() + (middle + by_m.transpose());
    return x;
  }
  bool of_ball(int v) const { return v >= gel_.num_vertices(); }
  double reach(const ContactPair& pair) const {
    const auto [low, high] = std::minmax_element(pair.vertices.begin(), pair.vertices.end());
    if (of_ball(*low) != of_ball(*high)) return kRadius;
    const double at_rest = closest_feature(pair, gather(mesh_.rest_positions, pair)).squared_distance;
    return std::min(kRadius, 0.5 * std::sqrt(at_rest));
  }
  /// Number of the ball's pairs with itself that count; every pair that does must be found.
  int expect_finds_all(GelsSearch& search, const Positions& p) {
    std::vector<ContactPair> pairs;
    search.pairs(x_, p, kRadius, pairs);
    const std::vector<ContactPair> found = sorted(std::move(pairs));
    EXPECT_TRUE(std::adjacent_find(found.begin(), found.end(), same) == found.end()) << "a pair counts twice";
    int near = 0;
    for (const ContactPair& pair : all_) {
      double nearest = 1.0;
      for (const double t : {0.0, 0.5, 1.0})
        nearest = std::min(nearest, closest_feature(pair, gather(x_ + t * p, pair)).squared_distance);
      if (std::sqrt(nearest) >= reach(pair)) continue;
      if (of_ball(*std::min_element(pair.vertices.begin(), pair.vertices.end()))) ++near;
      EXPECT_TRUE(std::binary_search(found.begin(), found.end(), pair, less));
    }
    return near;
  }

  const TetMesh gel_ = block_gel(3, 0.004, 0.002);
  const TriangleMesh ball_ = sphere(1.5e-3, 2);
  ContactMesh mesh_;
  std::vector<ContactPair> all_;
  Positions x_;
  std::mt19937 random_{3};
};

TEST_F(BallOverAGel, CrumpledAndRollingItsPairsWithItselfAreFound) {
  GelsSearch search(mesh_);
  int near = 0;
  for (int call = 0; call < 6; ++call) {
    const Positions end = rolled(x_, 0.4, {1e-3, -2e-3, 5e-4}) + shaken(call % 2 == 0 ? 0.35e-3 : 4e-6);
    const Positions p = end - x_;
    near += expect_finds_all(search, p);
    x_ = end;
  }
  EXPECT_GT(near, 100);
}

TEST_F(BallOverAGel, WithoutADeformationItIsNotSearchedAgainHoweverFarItGoes) {
  GelsSearch search(mesh_);
  const Positions still = Positions::Zero(x_.rows(), 3);
  x_ += shaken(0.35e-3);
  const int near = expect_finds_all(search, still), searches = search.num_searches();
  EXPECT_GT(near, 20);
  for (int call = 0; call < 4; ++call) {
    x_ = rolled(x_, 0.9, {3e-3, 0, 1e-3});
    EXPECT_EQ(expect_finds_all(search, still), near);
  }
  // On a straight way, too.
  EXPECT_EQ(expect_finds_all(search, rolled(x_, 0.0, {0, 5e-3, 0}) - x_), near);
  EXPECT_EQ(search.num_searches(), searches);
}

TEST_F(BallOverAGel, AroundMovingVerticesNoNearPairIsMissed) {
  GelsSearch search(mesh_);
  x_ = rolled(x_ + shaken(0.2e-3), 2.0, {0, 0, 1e-3});
  const Positions p = rolled(x_, 0.02, {2e-4, 0, 0}) - x_;
  std::vector<ContactPair> pairs;
  search.pairs(x_, p, kRadius, pairs);
  x_ += 0.4 * p;
  std::vector<bool> moves(static_cast<std::size_t>(x_.rows()), false);
  const Eigen::RowVector3d pole = x_.row(x_.rows() - 1);
  for (Eigen::Index v = 0; v < x_.rows(); ++v) moves[static_cast<std::size_t>(v)] = (x_.row(v) - pole).norm() < 1.3e-3;
  ASSERT_GT(std::count(moves.begin(), moves.end(), true), 6);
  constexpr double kFar_m = 0.3e-3;
  std::vector<ContactPair> around;
  search.around({moves.begin(), moves.end()}, reach_m(moves, kFar_m), x_, kRadius, around);
  around = sorted(std::move(around));
  int near = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const Positions far = kFar_m / std::sqrt(3.0) * shaken(1.0).cwiseSign();
    Positions moved = x_;
    for (Eigen::Index v = 0; v < moved.rows(); ++v) {
      if (moves[static_cast<std::size_t>(v)]) moved.row(v) += far.row(v);
    }
    for (const ContactPair& pair : all_) {
      const auto& v = pair.vertices;
      if (!(moves[v[0]] || moves[v[1]] || moves[v[2]] || moves[v[3]])) continue;
      const double within = reach(pair);
      if (closest_feature(pair, gather(moved, pair)).squared_distance >= within * within) continue;
      ++near;
      EXPECT_TRUE(std::binary_search(around.begin(), around.end(), pair, less));
    }
  }
  EXPECT_GT(near, 20);
}

/// SelfSearch by itself: the ball's own places are those of its frame.
TEST_F(BallOverAGel, HasNoFlatFaceAndIsSearchedWhole) {
  const ContactMesh& alone = *mesh_.gels[1].mesh;
  const OpenFace face(alone);
  for (int v = 0; v < alone.num_vertices(); ++v) EXPECT_FALSE(face.has(v));
  SelfSearch itself(alone);
  const std::vector<ContactPair> all = all_pairs(alone.gel);
  Positions x = alone.rest_positions;
  // Squeezed flat, its poles come near each other.
  x.col(2) *= 0.05;
  std::vector<ContactPair> found;
  itself.pairs(x, Positions::Zero(x.rows(), 3), kRadius, found);
  found = sorted(std::move(found));
  int near = 0;
  for (const ContactPair& pair : all) {
    const double at_rest = closest_feature(pair, gather(alone.rest_positions, pair)).squared_distance;
    const double within = std::min(kRadius, 0.5 * std::sqrt(at_rest));
    if (closest_feature(pair, gather(x, pair)).squared_distance >= within * within) continue;
    ++near;
    EXPECT_TRUE(std::binary_search(found.begin(), found.end(), pair, less));
  }
  EXPECT_GT(near, 300);
}

}  // namespace gels_search_test
}  // namespace tacipc
