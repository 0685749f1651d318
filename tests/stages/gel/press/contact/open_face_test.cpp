// The proof that a face is nowhere near itself: never wrong, and given where it should be.
#include "stages/gel/press/contact/open_face.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stages/gel/press/contact/contact_pair.h"
#include "tests/stages/gel/press/contact/random_points.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace {

ContactMesh gel_alone(const TetMesh& gel) {
  return make_contact_mesh(gel.positions, boundary_triangles(gel.tets, gel.positions.rows()), Positions(0, 3),
                           Triangles(0, 3));
}

/// Hands pairs of primitives of the face that share no vertex to use(pair, distance at x, distance at rest).
template <typename Use>
void for_each_pair(const ContactMesh& mesh, const OpenFace& face, const Positions& x, Use&& use) {
  const auto offer = [&](const ContactPair& pair) {
    const auto& v = pair.vertices;
    if (!face.has(v[0]) || !face.has(v[1]) || !face.has(v[2]) || !face.has(v[3])) return;
    use(pair, std::sqrt(closest_feature(pair, gather(x, pair)).squared_distance),
        std::sqrt(closest_feature(pair, gather(mesh.rest_positions, pair)).squared_distance));
  };
  for (const int v : mesh.gel.vertices) {
    for (const auto& t : mesh.gel.triangles)
      if (v != t[0] && v != t[1] && v != t[2]) offer(point_triangle_pair(v, t));
  }
  for (const auto& e : mesh.gel.edges) {
    for (const auto& f : mesh.gel.edges)
      if (e < f && e[0] != f[0] && e[0] != f[1] && e[1] != f[0] && e[1] != f[1]) offer(edge_edge_pair(e, f));
  }
}

double smallest_ratio(const ContactMesh& mesh, const OpenFace& face, const Positions& x) {
  double smallest = std::numeric_limits<double>::infinity();
  for_each_pair(mesh, face, x,
                [&](const ContactPair&, double now, double rest) { smallest = std::min(smallest, now / rest); });
  return smallest;
}

TEST(OpenFace, IsTheTopOfAGelWithAConvexOutline) {
  const TetMesh gel = block_gel(4, 0.004, 0.002);
  const OpenFace face(gel_alone(gel));
  for (int v = 0; v < gel.num_vertices(); ++v) EXPECT_EQ(face.has(v), gel.positions(v, 2) == 0.0) << v;
}

TEST(OpenFace, ThereIsNoneWhereTheTopIsCurvedOrItsOutlineIsNotConvex) {
  const TetMesh gel = block_gel(4, 0.004, 0.002);
  TetMesh curved = gel;
  for (int v = 0; v < gel.num_vertices(); ++v)
    curved.positions(v, 2) -= 10.0 * gel.positions.row(v).head<2>().squaredNorm();
  TetMesh dented = gel;
  for (int v = 0; v < gel.num_vertices(); ++v) {
    if (std::abs(gel.positions(v, 1)) < 1e-9 && gel.positions(v, 0) > 1.9e-3) dented.positions(v, 0) -= 0.2e-3;
  }
  for (const TetMesh& none : {curved, dented}) {
    const OpenFace face(gel_alone(none));
    for (int v = 0; v < gel.num_vertices(); ++v) EXPECT_FALSE(face.has(v));
  }
}

TEST(OpenFace, WhatItCallsOpenKeepsHalfOfEveryDistanceAtRest) {
  std::mt19937 random(5);
  const TetMesh gel = block_gel(5, 0.005, 0.002);
  const ContactMesh mesh = gel_alone(gel);
  const OpenFace face(mesh);
  int open = 0, closed = 0;
  for (int trial = 0; trial < 60; ++trial) {
    // Stretched, turned and dented, more and more roughly.
    const double rough = 0.01e-3 * trial;
    Positions x = mesh.rest_positions, p(x.rows(), 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      x.row(v) += rough * random_vector(random).transpose();
      p.row(v) = rough * random_vector(random).transpose();
    }
    x.col(0) *= 0.8;
    x.col(2).array() += 0.3 * x.col(0).array().abs();
    if (!face.stays_open(x, p)) {
      ++closed;
      continue;
    }
    ++open;
    for (const double t : {0.0, 0.5, 1.0}) EXPECT_GE(smallest_ratio(mesh, face, x + t * p), 0.5) << trial;
  }
  EXPECT_GT(open, 10);
  EXPECT_GT(closed, 10);
}

TEST(OpenFace, BothSidesOfEveryPairThatComesNearAreAtRisk) {
  std::mt19937 random(11);
  const TetMesh gel = block_gel(8, 0.008, 0.002);
  const ContactMesh mesh = gel_alone(gel);
  const OpenFace face(mesh);
  constexpr double kDHat = 0.3e-3;
  int near_pairs = 0, spared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    // A pinch: what is within 1.5 mm of a place is drawn together, some of it beyond.
    const Eigen::RowVector2d centre = 2e-3 * random_vector(random).head<2>().transpose();
    const double strength = 0.3 + 0.02 * trial;
    Positions x = mesh.rest_positions, p = Positions::Zero(x.rows(), 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      const Eigen::RowVector2d from = x.row(v).head<2>() - centre;
      const double weight = std::max(0.0, 1.0 - from.squaredNorm() / (1.5e-3 * 1.5e-3));
      (trial % 2 == 0 ? p : x).row(v).head<2>() -=
          strength * weight * Eigen::RowVector2d(2.0 * from.x(), 0.5 * from.y());
    }
    const OpenFace::Places at_risk = face.at_risk(x, p, kDHat);
    for (const double t : {0.0, 0.5, 1.0}) {
      for_each_pair(mesh, face, x + t * p, [&](const ContactPair& pair, double now, double rest) {
        const auto& v = pair.vertices;
        const bool near = now < std::min(kDHat, 0.5 * rest);
        const bool first = at_risk.near(std::array{v[0]}) ||
                           (pair.kind == ContactPair::Kind::edge_edge && at_risk.near(std::array{v[0], v[1]})),
                   second = pair.kind == ContactPair::Kind::edge_edge ? at_risk.near(std::array{v[2], v[3]})
                                                                      : at_risk.near(std::array{v[1], v[2], v[3]});
        spared += !first || !second;
        near_pairs += near;
        if (near) {
          EXPECT_TRUE(first && second) << "trial " << trial << " at " << t;
        }
      });
    }
  }
  EXPECT_GT(near_pairs, 100);
  EXPECT_GT(spared, 100000);
}

TEST(OpenFace, APlaceSetIsWithinAnotherOnlyIfThatHasAllOfIt) {
  const TetMesh gel = block_gel(8, 0.008, 0.002);
  const ContactMesh mesh = gel_alone(gel);
  const OpenFace face(mesh);
  const Positions& x = mesh.rest_positions;
  const auto turned_over = [&](double from) {  // what lies beyond x = `from` is folded back
    Positions p = Positions::Zero(x.rows(), 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v) p(v, 0) = -1.5 * std::max(0.0, x(v, 0) - from);
    return face.at_risk(x, p, 1e-6);
  };
  const OpenFace::Places none = face.at_risk(x, Positions::Zero(x.rows(), 3), 1e-6), few = turned_over(2.9e-3),
                         many = turned_over(0.9e-3);
  EXPECT_TRUE(none.none());
  EXPECT_FALSE(few.none());
  for (const auto* set : {&none, &few, &many}) {
    EXPECT_TRUE(none.within(*set));
    EXPECT_TRUE(set->within(*set));
  }
  EXPECT_TRUE(few.within(many));
  EXPECT_FALSE(many.within(few));
  EXPECT_FALSE(few.within(none));
}

TEST(OpenFace, AFoldOnTheWayIsSeen) {
  const TetMesh gel = block_gel(6, 0.006, 0.002);
  const ContactMesh mesh = gel_alone(gel);
  const OpenFace face(mesh);
  const Positions& x = mesh.rest_positions;
  Positions p = Positions::Zero(x.rows(), 3);
  EXPECT_TRUE(face.stays_open(x, p));
  p.col(0) = -1.8 * x.col(0);  // turns over, and is as wide as before at the end but for the sign
  EXPECT_FALSE(face.stays_open(x, p));
  EXPECT_FALSE(face.stays_open(x + p, p));
}

}  // namespace
}  // namespace tacipc
