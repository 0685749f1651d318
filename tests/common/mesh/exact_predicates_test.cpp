#include "common/mesh/exact_predicates.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "tests/stages/gel/press/contact/random_points.h"

namespace tacipc {
namespace exact_predicates_test {

int rational_orient3d(const FourPoints& x) {
  std::array<std::array<mpq_class, 3>, 3> e;
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) e[i][c] = mpq_class(x[i + 1][c]) - mpq_class(x[0][c]);
  const mpq_class det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                        e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                        e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  return sgn(det);
}

TEST(Orient3d, KnowsThePositiveTetrahedron) {
  const Vector3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_EQ(orient3d(o, x, y, z), 1);
  EXPECT_EQ(orient3d(o, y, x, z), -1);
  EXPECT_EQ(orient3d(o, x, y, Vector3(3, 7, 0)), 0);
}

TEST(Orient3d, IsExactNextToAPlane) {
  // Points of one tilted plane as far as doubles allow, then one coordinate moved by a few units in the last place.
  std::mt19937 random(16);
  std::array<int, 3> met{};
  for (int i = 0; i < 20000; ++i) {
    FourPoints x = random_points(random);
    const double a = random_unit(random), b = random_unit(random);
    x[3] = x[0] + a * (x[1] - x[0]) + b * (x[2] - x[0]);
    if (i % 4 == 0) x[3] = 0.5 * (x[0] + x[1]);
    for (int step = i % 3; step > 0; --step) x[3][0] = std::nextafter(x[3][0], 9.0);
    const int expected = rational_orient3d(x);
    EXPECT_EQ(orient3d(x[0], x[1], x[2], x[3]), expected) << to_string(x);
    EXPECT_EQ(orient3d(x[1], x[0], x[2], x[3]), -expected) << to_string(x);
    ++met[expected + 1];
  }
  for (const int count : met) EXPECT_GT(count, 100);
}

TEST(Orient3d, IsExactAtExtremeSizes) {
  const Vector3 o(0, 0, 0);
  for (const double size : {1e-320, 1e-200, 1e-100, 1e100, 1e200}) {
    EXPECT_EQ(orient3d(o, Vector3(size, 0, 0), Vector3(0, size, 0), Vector3(0, 0, size)), 1) << size;
    EXPECT_EQ(orient3d(o, Vector3(size, size, 0), Vector3(0, size, size), Vector3(size, 2 * size, size)), 0) << size;
  }
  const FourPoints mixed{o, Vector3(1e150, 1, 0), Vector3(0, 1e-150, 1), Vector3(1e150, 1 + 1e-150, 1)};
  EXPECT_EQ(orient3d(mixed[0], mixed[1], mixed[2], mixed[3]), rational_orient3d(mixed));
}

TEST(SegmentTriangle, ClosedForms) {
  const TrianglePoints t{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)};
  const auto meets = [&](const Vector3& p, const Vector3& q) { return segment_intersects_triangle(p, q, t); };
  EXPECT_TRUE(meets({1, 1, -1}, {1, 1, 1})) << "through the inside";
  EXPECT_TRUE(meets({2, 0, -1}, {2, 0, 1})) << "through an edge";
  EXPECT_TRUE(meets({4, 0, -1}, {4, 0, 1})) << "through a corner";
  EXPECT_TRUE(meets({1, 1, 0}, {1, 1, 5})) << "standing on it";
  EXPECT_FALSE(meets({1, 1, 1e-300}, {1, 1, 5})) << "standing just above";
  EXPECT_FALSE(meets({3, 3, -1}, {3, 3, 1})) << "past it";
  EXPECT_TRUE(meets({1, 1, 0}, {1.5, 1, 0})) << "lying inside";
  EXPECT_TRUE(meets({-1, 1, 0}, {9, 1, 0})) << "lying across";
  EXPECT_TRUE(meets({-1, 0, 0}, {0, -0.0, 0})) << "lying, end at a corner";
  EXPECT_TRUE(meets({3, 2, 0}, {2, 2, 0})) << "lying, end on the long edge";
  EXPECT_FALSE(meets({3, 2, 0}, {2.5, 2, 0})) << "lying beside";
  EXPECT_TRUE(meets({1, 1, 0}, {1, 1, 0})) << "a point on it";
  EXPECT_FALSE(meets({1, 1, 1}, {1, 1, 1})) << "a point above it";
}

TEST(SegmentTriangle, TriangleWithoutAreaIsASegment) {
  const TrianglePoints t{Vector3(0, 0, 0), Vector3(1, 1, 1), Vector3(3, 3, 3)};
  EXPECT_TRUE(segment_intersects_triangle({2, 2, 0}, {2, 2, 4}, t));
  EXPECT_TRUE(segment_intersects_triangle({2, 2, 2}, {9, 9, 9}, t));
  EXPECT_FALSE(segment_intersects_triangle({4, 4, 4}, {9, 9, 9}, t));
  EXPECT_FALSE(segment_intersects_triangle({2, 2.1, 0}, {2, 2.1, 4}, t));
  const TrianglePoints point{Vector3(1, 1, 1), Vector3(1, 1, 1), Vector3(1, 1, 1)};
  EXPECT_TRUE(segment_intersects_triangle({0, 0, 0}, {3, 3, 3}, point));
  EXPECT_FALSE(segment_intersects_triangle({0, 0, 0}, {3, 3, 4}, point));
}

TEST(TrianglesIntersect, ClosedForms) {
  const TrianglePoints t{Vector3(0, 0, 0), Vector3(4, 0, 0), Vector3(0, 4, 0)};
  const auto meets = [&](const TrianglePoints& other) {
    EXPECT_EQ(triangles_intersect(t, other), triangles_intersect(other, t));
    return triangles_intersect(t, other);
  };
  EXPECT_TRUE(meets({Vector3(1, 1, -1), Vector3(1, 1, 1), Vector3(9, 9, 1)})) << "piercing";
  EXPECT_TRUE(meets({Vector3(1, 1, 0), Vector3(1, 1, 1), Vector3(9, 9, 1)})) << "standing on a corner";
  EXPECT_FALSE(meets({Vector3(1, 1, 1e-12), Vector3(1, 1, 1), Vector3(9, 9, 1)})) << "above";
  EXPECT_TRUE(meets({Vector3(1, 1, 0), Vector3(1.5, 1, 0), Vector3(1, 1.5, 0)})) << "one inside the other";
  EXPECT_FALSE(meets({Vector3(4, 4, 0), Vector3(3, 4, 0), Vector3(4, 3, 0)})) << "side by side";
  EXPECT_TRUE(meets(t)) << "the same";
}

TEST(TrianglesIntersect, RandomPairsWithAKnownCommonPoint) {
  // Both triangles are cut from a common point with positive weights on a lattice, so they meet exactly.
  std::mt19937 random(17);
  for (int i = 0; i < 2000; ++i) {
    std::array<TrianglePoints, 2> t;
    const Vector3 meeting = lattice_points(random, 20)[0];
    for (TrianglePoints& corners : t) {
      const FourPoints e = lattice_points(random, 20);
      corners = {meeting + e[0], meeting + e[1], meeting - e[0] - e[1]};  // the mean is the meeting point
    }
    EXPECT_TRUE(triangles_intersect(t[0], t[1]));
  }
}

TEST(HingeIsFoldedFlat, OnlyWhenOneTriangleLiesOnTheOther) {
  const Vector3 v(0, 0, 0), w(1, 2, 3), a(1, 0, 0);
  EXPECT_TRUE(hinge_is_folded_flat(v, w, a, Vector3(2, 0, 0)));
  EXPECT_TRUE(hinge_is_folded_flat(v, w, a, a));
  EXPECT_FALSE(hinge_is_folded_flat(v, w, a, Vector3(-2, 0, 0)));
  EXPECT_FALSE(hinge_is_folded_flat(v, w, a, Vector3(2, 0, 1e-300)));
}

}  // namespace exact_predicates_test
}  // namespace tacipc
