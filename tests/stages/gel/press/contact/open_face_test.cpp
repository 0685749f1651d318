// The proof that a face is nowhere near itself: never wrong, and given where it should be.
#include "stages/gel/press/contact/open_face.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stages/gel/press/contact/contact_pair.h"
#include "tests/stages/gel/press/contact/random_points.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace open_face_test {

ContactMesh gel_alone(const TetMesh& gel) {
  return make_contact_mesh(gel.positions, boundary_triangles(gel.tets, gel.positions.rows()), {});
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
    if (!face.at_risk(x, p, 0.0).none()) {
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
  for (int trial = 0; trial < 60; ++trial) {
    // A pinch: what is within 1.5 mm of a place is drawn together, some of it beyond.
    const Eigen::RowVector2d centre = 2e-3 * random_vector(random).head<2>().transpose();
    const double strength = 0.3 + 0.02 * trial;
    Positions x = mesh.rest_positions, p = Positions::Zero(x.rows(), 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      const Eigen::RowVector2d from = x.row(v).head<2>() - centre;
      const double weight = std::max(0.0, 1.0 - from.squaredNorm() / (1.5e-3 * 1.5e-3));
      (trial % 2 == 0 ? p : x).row(v).head<2>() -=
          strength * weight * Eigen::RowVector2d(2.0 * from.x(), 0.5 * from.y());
      // Most are dragged along as well, all but the rim as far.
      if (trial % 3 > 0)
        x.row(v).head<2>() += std::clamp(4e-3 - mesh.rest_positions.row(v).head<2>().cwiseAbs().maxCoeff(), 0.0, 1e-3) *
                              Eigen::RowVector2d(0.9, 0.3);
    }
    if (trial >= 40) {  // instead: a vertex goes across the face
      const Eigen::RowVector3d near_it(2.0 * centre.x(), 2.0 * centre.y(), 0.0);
      Eigen::Index v = 0;
      (mesh.rest_positions.rowwise() - near_it).rowwise().norm().minCoeff(&v);
      x = mesh.rest_positions;
      p.setZero();
      p.row(v).head<2>() = -1.2 * mesh.rest_positions.row(v).head<2>();
      if (trial % 2 == 0) {  // it comes back from there
        x += p;
        p = -p;
      }
    }
    const OpenFace::Places at_risk = face.at_risk(x, p, kDHat);
    for (const double t : {0.0, 0.5, 1.0}) {
      for_each_pair(mesh, face, x + t * p, [&](const ContactPair& pair, double now, double rest) {
        const auto& v = pair.vertices;
        const bool near = now < std::min(kDHat, 0.5 * rest);
        const auto at = [&](const auto& vertices) { return at_risk.near(face.squares_around(vertices)); };
        const bool of_edges = pair.kind == ContactPair::Kind::edge_edge;
        const bool first = at(std::array{v[0]}) || (of_edges && at(std::array{v[0], v[1]}));
        const bool second = of_edges ? at(std::array{v[2], v[3]}) : at(std::array{v[1], v[2], v[3]});
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

TEST(OpenFace, DraggedFarOnlyPlacesAroundAFoldAreAtRisk) {
  const TetMesh gel = block_gel(24, 0.012, 0.002);
  const ContactMesh mesh = gel_alone(gel);
  const OpenFace face(mesh);
  // The middle is 1 mm to the right of where it was, which goes down to zero at the rim; in it a vertex is beyond the
  // next one, 0.5 mm away.
  Positions x = mesh.rest_positions;
  int folded = -1;
  for (int v = 0; v < gel.num_vertices(); ++v) {
    const double from_middle = gel.positions.row(v).head<2>().cwiseAbs().maxCoeff();
    x(v, 0) += 0.2 * std::min(6e-3 - from_middle, 5e-3);
    if (face.has(v) && from_middle < 1e-9) folded = v;
  }
  const Positions still = Positions::Zero(x.rows(), 3);
  ASSERT_TRUE(face.at_risk(x, still, 0.0).none());
  ASSERT_GE(folded, 0);
  x(folded, 0) += 0.6e-3;
  const OpenFace::Places at_risk = face.at_risk(x, still, 0.1e-3);
  for (int v = 0; v < gel.num_vertices(); ++v) {
    if (!face.has(v)) continue;
    const double away = gel.positions.row(v).head<2>().norm();
    if (away < 0.6e-3 || away > 2.5e-3) {
      EXPECT_EQ(at_risk.near(face.squares_around(std::array{v})), away < 0.6e-3) << away;
    }
  }
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
  EXPECT_TRUE(face.at_risk(x, p, 0.0).none());
  p.col(0) = -1.8 * x.col(0);  // turns over, and is as wide as before at the end but for the sign
  EXPECT_FALSE(face.at_risk(x, p, 0.0).none());
  EXPECT_FALSE(face.at_risk(x + p, p, 0.0).none());
}

}  // namespace open_face_test
}  // namespace tacipc
