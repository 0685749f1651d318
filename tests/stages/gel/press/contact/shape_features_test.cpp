// Corners and creases of solids, whatever triangles these are cut into.
#include "stages/gel/press/contact/shape_features.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <set>

#include "tests/make_mesh.h"
#include "tests/stages/gel/press/cut_box.h"

namespace tacipc {
namespace shape_features_test {

struct Shape {
  Surface surface;
  ShapeFeatures found;
  std::set<std::array<int, 2>> creases;
  int corners = 0;

  explicit Shape(const TriangleMesh& mesh) : surface(make_surface(mesh.triangles, 0)) {
    found = shape_features(surface, mesh.positions);
    for (std::size_t e = 0; e < surface.edges.size(); ++e)
      if (!found.is_flat[e]) creases.insert(found.crease[e]);
    for (const char corner : found.is_corner) corners += corner;
  }
};

TEST(ShapeFeatures, ABoxHasEightCornersAndTwelveCreasesHoweverItIsCutAndTurned) {
  const Vector3 half(3.0, 2.0, 0.25);
  const Eigen::AngleAxisd turn(0.7, Vector3(1.0, -2.0, 0.5).normalized());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1e-7, 1e-7);  // coordinates of single precision
  for (const Cut cut : {Cut::diagonal, Cut::other_diagonal, Cut::fan, Cut::grid}) {
    TriangleMesh box = cut_box(half, cut);
    box.positions = box.positions * turn.toRotationMatrix().transpose();
    for (double& value : box.positions.reshaped()) value += noise(random);
    const Shape shape(box);
    EXPECT_EQ(shape.corners, 8) << static_cast<int>(cut);
    EXPECT_EQ(shape.creases.size(), 12u) << static_cast<int>(cut);
    for (const auto& [a, b] : shape.creases) {
      EXPECT_TRUE(shape.found.is_corner[a] && shape.found.is_corner[b]);
    }
  }
}

TEST(ShapeFeatures, RoundSurfacesKeepTheirVerticesAndEdges) {
  const Shape ball(sphere(5e-3, 3));
  EXPECT_EQ(ball.corners, static_cast<int>(ball.surface.vertices.size()));
  EXPECT_EQ(ball.creases.size(), ball.surface.edges.size());
  // A lens of 1 m radius, 2 mm wide: from triangle to triangle it bends by 2e-4.
  TriangleMesh lens = cut_box({1e-3, 1e-3, 1e-3}, Cut::grid, 10);
  for (Eigen::Index v = 0; v < lens.num_vertices(); ++v) {
    auto p = lens.positions.row(v);
    p.z() = p.z() > 0.0 ? -0.5 * p.head<2>().squaredNorm() : -1e-3;
  }
  const Shape curved(lens);
  for (const int v : curved.surface.vertices) {
    const auto p = lens.positions.row(v);
    const bool inside = p.z() > -5e-4 && p.head<2>().cwiseAbs().maxCoeff() < 0.95e-3;
    EXPECT_TRUE(!inside || curved.found.is_corner[v]) << p;
  }
}

TEST(ShapeFeatures, FacesMayMeetInwards) {
  const Shape shape(make_l_shape());
  EXPECT_EQ(shape.corners, 12);
  EXPECT_EQ(shape.creases.size(), 18u);
}

TEST(ShapeFeatures, APolygonThatBendsLittleByLittleIsCutIntoStraightCreases) {
  for (const int n : {400, 4000}) {
    TriangleMesh bow = cut_box({1.0, 1.0, 0.1}, Cut::fan, n);
    const double bend = 2e-6;  // per piece of the front edge, which bows out
    for (Eigen::Index v = 0; v < bow.num_vertices(); ++v) {
      auto p = bow.positions.row(v);
      if (p.y() <= -1.0) p.y() -= 0.25 * bend * n * (1.0 - p.x() * p.x());
    }
    const Shape shape(bow);
    // The whole bow turns by n × bend: a crease by kFlat at most, and by one piece to the next crease.
    EXPECT_GE(shape.corners, 8 + 2 * (static_cast<int>(n * bend / (kFlat + bend)) - 1)) << n;
    for (const auto& [a, b] : shape.creases) {
      const Vector3 chord = bow.positions.row(b) - bow.positions.row(a);
      EXPECT_LE(chord.norm(), 2.0 + 1e-9);
    }
  }
}

}  // namespace shape_features_test
}  // namespace tacipc
