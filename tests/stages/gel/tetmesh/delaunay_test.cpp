#include "stages/gel/tetmesh/delaunay.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "stages/gel/tetmesh/face_mesh.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace delaunay_test {

double area_of(const std::vector<Vector2>& points, const Triangles& triangles) {
  double area = 0.0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Vector2 u = points[triangles(t, 1)] - points[triangles(t, 0)],
                  v = points[triangles(t, 2)] - points[triangles(t, 0)];
    const double twice = u.x() * v.y() - u.y() * v.x();
    EXPECT_GT(twice, 0.0) << "triangle " << t;
    area += twice / 2.0;
  }
  return area;
}

TEST(Delaunay, NoPointLiesInsideACircumcircle) {
  std::vector<Vector2> points;
  for (std::uint64_t i = 0; i < 300; ++i) points.push_back({random_uniform(3, 0, i), 2.0 * random_uniform(3, 1, i)});
  const Triangles triangles = delaunay(points);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Vector2 a = points[triangles(t, 0)], b = points[triangles(t, 1)], c = points[triangles(t, 2)];
    Eigen::Matrix2d sides;
    sides << (b - a).transpose(), (c - a).transpose();
    const Vector2 centre = a + sides.partialPivLu().solve(0.5 * Vector2((b - a).squaredNorm(), (c - a).squaredNorm()));
    for (std::size_t p = 0; p < points.size(); ++p) {
      EXPECT_GE((points[p] - centre).norm(), (a - centre).norm() * (1.0 - 1e-6)) << "triangle " << t << ", point " << p;
    }
  }
}

TEST(Delaunay, ALatticeFullOfTiesIsCoveredExactlyOnce) {
  std::vector<Vector2> points;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 13; ++j) points.push_back({0.1 * i, 0.1 * j});
  const Triangles triangles = delaunay(points);
  EXPECT_EQ(triangles.rows(), 2 * 19 * 12);
  EXPECT_NEAR(area_of(points, triangles), 1.9 * 1.2, 1e-12);
  // Euler: V − E + F = 1 for a disc.
  EXPECT_EQ(static_cast<Eigen::Index>(points.size()) - static_cast<Eigen::Index>(unique_edges(triangles).size()) +
                triangles.rows(),
            1);
}

TEST(Delaunay, PointsOnACircleFillItsPolygon) {
  std::vector<Vector2> points;
  for (int i = 0; i < 97; ++i) points.push_back({std::cos(i * 2.0 * M_PI / 97), std::sin(i * 2.0 * M_PI / 97)});
  const Triangles triangles = delaunay(points);
  EXPECT_EQ(triangles.rows(), 95);
  EXPECT_NEAR(area_of(points, triangles), 97.0 / 2.0 * std::sin(2.0 * M_PI / 97), 1e-6);
}

TEST(Delaunay, RefusesWhatHasNoTriangulation) {
  EXPECT_EQ(message_of<DataError>([] { delaunay({{0, 0}, {1, 0}}); }), "2 points have no triangulation");
  EXPECT_EQ(message_of<DataError>([] {
              delaunay({{0, 0}, {1, 1}, {2, 2}, {3, 3}});
            }),
            "all 4 points of a face lie on one line");
  EXPECT_EQ(message_of<DataError>([] {
              delaunay({{0, 0}, {1, 0}, {0, 1}, {1, 0}});
            }),
            "two points of a face coincide (points 1 and 3)");
}

}  // namespace delaunay_test
}  // namespace tacipc
