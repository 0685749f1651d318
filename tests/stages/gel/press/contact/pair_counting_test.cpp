// Pairs counted once: a surface pushes the same wherever its triangles meet.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "common/sample/placement.h"
#include "stages/gel/press/contact/near_pairs.h"
#include "stages/gel/press/contact/pair_counting.h"
#include "stages/gel/press/energy/barrier.h"
#include "stages/gel/press/energy/contact_barrier.h"
#include "stages/gel/press/solve/assembly.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace pair_counting_test {

constexpr double kDHat = 0.3;

/// A sheet of irregular triangles about 0.2 long over [−1, 1]², z = height(x, y).
TriangleMesh sheet(const std::function<double(double, double)>& height) {
  const int n = 11;
  TriangleMesh mesh;
  mesh.positions.resize(n * n, 3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> shift(-0.06, 0.06);
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const double x = 0.2 * i - 1.0 + shift(random), y = 0.2 * j - 1.0 + shift(random);
      mesh.positions.row(j * n + i) << x, y, height(x, y);
    }
  }
  mesh.triangles.resize(2 * (n - 1) * (n - 1), 3);
  for (int j = 0, f = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i, f += 2) {
      const int a = j * n + i, b = a + 1, c = a + n, d = c + 1;
      mesh.triangles.row(f) << a, b, d;
      mesh.triangles.row(f + 1) << a, d, c;
    }
  }
  return mesh;
}

/// One gel vertex beside an object, every triangle of which counts as near.
struct OnePoint {
  ContactMesh mesh;
  std::vector<ContactPair> pairs;
  Positions x;
  ContactLaws laws{{.d_hat_m = kDHat}};

  OnePoint(const TriangleMesh& object, const Vector3& point) {
    mesh = make_contact_mesh(Positions{{point.x(), point.y(), point.z()}}, Triangles(0, 3), {object});
    for (Eigen::Index f = 0; f < object.num_triangles(); ++f) {
      pairs.push_back({ContactPair::Kind::point_triangle,
                       {0, 1 + object.triangles(f, 0), 1 + object.triangles(f, 1), 1 + object.triangles(f, 2)}});
    }
    x = mesh.rest_positions;
  }
  ContactBarrier barrier(bool once) const { return {mesh, weighted(pairs, mesh, laws, {.once = once}), laws}; }
  double energy(bool once) const {
    const ContactBarrier term = barrier(once);
    double sum = 0.0;
    Local local;
    Eigen::VectorXd at;
    for (int i = 0; i < term.num_stencils(); ++i) {
      gather(x, term.stencil(i), at);
      term.evaluate(i, at, Order::value, local);
      sum += local.value;
    }
    return sum;
  }
  Vector3 push(bool once) const { return -gradient_of(barrier(once), x).row(0).transpose(); }
};

TEST(PairCounting, PlanePushesStraightAndTheSameEverywhere) {
  const TriangleMesh plane = sheet([](double, double) { return 0.0; });
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.5, 0.5), gap(0.05, 0.28);
  double most_askew = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double d = gap(random);
    const OnePoint scene(plane, {place(random), place(random), d});
    const double one = barrier(d * d, kDHat * kDHat), force = -2.0 * d * barrier_d1(d * d, kDHat * kDHat);
    EXPECT_NEAR(scene.energy(true), one, 1e-12 * one);
    EXPECT_LT((scene.push(true) - Vector3(0, 0, force)).norm(), 1e-11 * force);
    EXPECT_GT(scene.energy(false), one * (1 - 1e-12));
    most_askew = std::max(most_askew, scene.push(false).head<2>().norm() / scene.push(false).z());
  }
  EXPECT_GT(most_askew, 0.3);  // what the weights are for
}

TEST(PairCounting, ConvexSurfacePushesWithItsNearestPoint) {
  const TriangleMesh dome = sheet([](double x, double y) { return -0.2 * (x * x + y * y); });
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-0.5, 0.5), gap(0.02, 0.25);
  for (int i = 0; i < 200; ++i) {
    const double u = place(random), v = place(random);
    const OnePoint scene(dome, {u, v, -0.2 * (u * u + v * v) + gap(random)});
    const double d = smallest_distance(scene.pairs, scene.x, 10.0);
    if (d >= kDHat) continue;
    // Not exactly convex (the diagonals), but each cell's nearest point lies on one that is counted out.
    const double one = barrier(d * d, kDHat * kDHat);
    EXPECT_NEAR(scene.energy(true), one, 0.05 * one) << u << ", " << v;
  }
}

TEST(PairCounting, TwoSheetsPushTwiceAndAFoldStaysRepulsive) {
  const TriangleMesh low = sheet([](double, double) { return 0.0; });
  TriangleMesh both = low;
  both.positions.conservativeResize(2 * low.num_vertices(), 3);
  both.positions.bottomRows(low.num_vertices()) = low.positions.rowwise() + Eigen::RowVector3d(0, 0, 0.5);
  both.triangles.conservativeResize(2 * low.num_triangles(), 3);
  both.triangles.bottomRows(low.num_triangles()) = low.triangles.array() + static_cast<int>(low.num_vertices());
  const double half = barrier(0.25 * 0.25, kDHat * kDHat);
  EXPECT_NEAR(OnePoint(both, {0.03, 0.07, 0.25}).energy(true), 2 * half, 1e-12 * half);

  // The bottom of a groove: the nearest point pushes at least with half of what it would alone, away from itself.
  const TriangleMesh groove = sheet([](double x, double) { return 0.8 * std::abs(x); });
  for (const double x : {-0.1, -0.02, 0.0, 0.05}) {
    const OnePoint scene(groove, {x, 0.01, 0.8 * std::abs(x) + 0.1});
    const double d = smallest_distance(scene.pairs, scene.x, 10.0);
    EXPECT_GT(scene.energy(true), 0.5 * barrier(d * d, kDHat * kDHat)) << x;
    EXPECT_GT(scene.push(true).z(), 0.0) << x;
  }
}

TEST(PairCounting, EveryPairIsLeftAlone) {
  const OnePoint scene(sheet([](double, double) { return 0.0; }), {0, 0, 0.1});
  const auto same = weighted(scene.pairs, scene.mesh, scene.laws, {});
  ASSERT_EQ(same.size(), scene.pairs.size());
  for (std::size_t i = 0; i < same.size(); ++i) EXPECT_EQ(same[i].weight, 1.0);
}

TEST(PairCounting, EdgesCountAsMuchAsTheyAreSharpAndGelPairsStay) {
  using Kind = ContactPair::Kind;
  // A roof of 2 × 45° over the ridge 10–11, and a gel of two triangles.
  const Positions roof{{0, -1, 0}, {0, 1, 0}, {1, 0, -1}, {-1, 0, -1}};
  const Triangles two{{0, 2, 1}, {0, 1, 3}};
  const Positions gel = Positions::Random(10, 3);
  const ContactMesh mesh = make_contact_mesh(gel, Triangles{{0, 1, 2}, {1, 3, 2}}, {{roof, two}});
  const std::vector<ContactPair> pairs{{Kind::edge_edge, {0, 1, 10, 11}},
                                       {Kind::edge_edge, {0, 1, 2, 3}},
                                       {Kind::point_triangle, {0, 1, 2, 3}},
                                       {Kind::point_triangle, {12, 1, 2, 3}}};
  const auto counted = weighted(pairs, mesh, ContactLaws(), {.once = true, .edge_weight = 0.1});
  ASSERT_EQ(counted.size(), 4u + 3u + 3u);
  EXPECT_NEAR(counted[0].weight, 1.0, 1e-12);
  EXPECT_EQ(counted[1].weight, 1.0);
  EXPECT_EQ(counted[2].weight, 1.0);
  for (std::size_t i = 4; i < 7; ++i) EXPECT_EQ(counted[i].weight, -1.0);
  for (std::size_t i = 7; i < 10; ++i) EXPECT_EQ(counted[i].weight, 1.0);

  Positions flat = roof;
  flat.col(2).tail(2).setConstant(-0.1);
  const ContactMesh smooth = make_contact_mesh(gel, Triangles{{0, 1, 2}, {1, 3, 2}}, {{flat, two}});
  EXPECT_EQ(weighted(pairs, smooth, ContactLaws(), {.once = true, .edge_weight = 0.1})[0].weight, 0.1);
}

/// Without friction a flat plate must not drag the gel, however its triangles are cut.
TEST(PairCounting, FacetsOfAPlateDoNotDrag) {
  TriangleMesh plate = sheet([](double, double) { return 0.0; });
  const int corners = static_cast<int>(plate.num_vertices()), n = 11;
  plate.positions *= 4e-3;
  plate.triangles.col(1).swap(plate.triangles.col(2));  // looks down
  plate.positions.conservativeResize(corners + 1, 3);
  plate.positions.row(corners) << 0, 0, 3e-3;
  std::vector<int> rim;
  for (int i = 0; i < n - 1; ++i) rim.push_back(i);
  for (int j = 0; j < n - 1; ++j) rim.push_back(j * n + n - 1);
  for (int i = n - 1; i > 0; --i) rim.push_back((n - 1) * n + i);
  for (int j = n - 1; j > 0; --j) rim.push_back(j * n);
  for (std::size_t k = 0; k < rim.size(); ++k) {
    plate.triangles.conservativeResize(plate.triangles.rows() + 1, 3);
    plate.triangles.bottomRows<1>() << rim[k], rim[(k + 1) % rim.size()], corners;
  }
  PressConfig config = paper_config();
  config.relative_d_hat = 0.02;
  SampleSpec sample = press(0.3e-3, 1);
  sample.motion.push_back({.kind = PhaseKind::shear, .steps = 6, .shift_m = {0.4e-3, 0, 0}});
  const auto worst_drag = [&](bool once) {
    config.pair_counting.once = once;
    const Simulation found =
        simulate(paper_sensor(), block_gel(6, 0.005, 0.002), plate, config, sample, "-z", ignore_progress);
    double worst = 0.0;
    for (const Frame& frame : found.frames)
      if (frame.phase == PhaseKind::shear)
        worst = std::max(worst, frame.force_n.head<2>().norm() / std::abs(frame.force_n.z()));
    return worst;
  };
  // What is left is the edges' (their weight); all that cross an edge near a corner still count.
  const double once = worst_drag(true), every = worst_drag(false);
  EXPECT_LT(once, 2e-3);
  EXPECT_GT(every, 5.0 * once);
}

}  // namespace pair_counting_test
}  // namespace tacipc
