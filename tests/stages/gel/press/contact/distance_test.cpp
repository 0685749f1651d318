// The closest feature against an independent minimisation, in general position and in every degenerate one.
#include "stages/gel/press/contact/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/stages/gel/press/contact/random_points.h"

namespace tacipc {
namespace distance_test {

using Long3 = Eigen::Matrix<long double, 3, 1>;
using LongPoints = std::array<Long3, 4>;

LongPoints in_long_double(const FourPoints& x) {
  LongPoints y;
  for (int i = 0; i < 4; ++i) y[i] = x[i].cast<long double>();
  return y;
}

/// Minimum of a convex function on [0, 1] by narrowing to the two thirds that must hold it.
template <typename F>
long double convex_minimum(const F& f) {
  long double low = 0, high = 1;
  for (int i = 0; i < 110; ++i) {
    const long double a = low + (high - low) / 3;
    const long double b = high - (high - low) / 3;
    if (f(a) < f(b))
      high = b;
    else
      low = a;
  }
  return std::min({f(low), f(0), f(1)});
}

/// Smallest |p + v q|² for 0 ≤ v ≤ 1.
long double to_segment(const Long3& p, const Long3& q) {
  const long double length2 = q.squaredNorm();
  const long double v = length2 > 0 ? std::clamp(-p.dot(q) / length2, 0.0L, 1.0L) : 0.0L;
  return (p + v * q).squaredNorm();
}

/// The triangle as segments parallel to its edge x2x3.
double brute_point_triangle(const FourPoints& points) {
  const LongPoints x = in_long_double(points);
  return static_cast<double>(convex_minimum(
      [&](long double u) -> long double { return to_segment(x[0] - x[1] - u * (x[2] - x[1]), -u * (x[3] - x[2])); }));
}

double brute_edge_edge(const FourPoints& points) {
  const LongPoints x = in_long_double(points);
  return static_cast<double>(convex_minimum(
      [&](long double s) -> long double { return to_segment(x[0] + s * (x[1] - x[0]) - x[2], x[2] - x[3]); }));
}

/// What holds for each feature whatever its type.
void expect_consistent(const ClosestFeature& f, const FourPoints& x) {
  Vector3 r = Vector3::Zero();
  Eigen::Matrix<double, 3, 2> A = Eigen::Matrix<double, 3, 2>::Zero();
  double size = 0;
  for (int i = 0; i < 4; ++i) {
    r += f.weights[i] * x[i];
    A += x[i] * f.W.row(i);
    size = std::max(size, x[i].lpNorm<Eigen::Infinity>());
  }
  EXPECT_LE((r - f.r).norm(), 1e-14 * size) << to_string(x);
  EXPECT_LE((A - f.A).norm(), 1e-14 * size) << to_string(x);
  EXPECT_NEAR(f.weights.sum(), 0, 1e-15) << to_string(x);
  EXPECT_EQ(f.W.colwise().sum().norm(), 0) << to_string(x);
  EXPECT_DOUBLE_EQ(f.squared_distance, f.r.squaredNorm());
  for (int q = 0; q < 2; ++q) {
    if (q < f.k)
      EXPECT_GT(f.A.col(q).norm(), 0) << to_string(x);
    else
      EXPECT_EQ(f.A.col(q).norm(), 0) << to_string(x);
    EXPECT_NEAR(f.A.col(q).dot(f.r), 0, 1e-13 * size * size) << to_string(x);
  }
}

struct Kind {
  const char* name;
  ClosestFeature (*closest)(const FourPoints&);
  double (*brute)(const FourPoints&);

  friend void PrintTo(const Kind& entry, std::ostream* out) { *out << entry.name; }
};
const Kind kKinds[] = {{"point_triangle", closest_point_triangle, brute_point_triangle},
                       {"edge_edge", closest_edge_edge, brute_edge_edge}};

class Distance : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Pairs, Distance, testing::ValuesIn(kKinds), [](const auto& test) { return test.param.name; });

TEST_P(Distance, IsTheMinimumInGeneralPosition) {
  std::mt19937 random(1);
  std::array<int, 3> met{};
  for (int i = 0; i < 1000; ++i) {
    const FourPoints x = random_points(random);
    const ClosestFeature f = GetParam().closest(x);
    const double expected = GetParam().brute(x);
    EXPECT_NEAR(f.squared_distance, expected, 1e-12 * expected) << to_string(x);
    expect_consistent(f, x);
    ++met[f.k];
  }
  for (int k = 0; k < 3; ++k) EXPECT_GT(met[k], 10) << "features with k = " << k;
}

TEST_P(Distance, IsTheMinimumOnALatticeFullOfDegenerateCases) {
  std::mt19937 random(2);
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const FourPoints x = lattice_points(random, 1 + i % 2);
    const ClosestFeature f = GetParam().closest(x);
    EXPECT_NEAR(f.squared_distance, GetParam().brute(x), 1e-13) << to_string(x);
    expect_consistent(f, x);
    touching += f.squared_distance < 1e-28;
  }
  EXPECT_GT(touching, 50);
}

TEST_P(Distance, IsTheMinimumForNearlyFlatOnes) {
  // Needles and nearly parallel edges: all four points within `thickness` of one line.
  std::mt19937 random(3);
  for (const double thickness : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    for (int i = 0; i < 150; ++i) {
      FourPoints x;
      for (Vector3& point : x) point = Vector3(1, 2, -1) * random_unit(random) + thickness * random_vector(random);
      if (i % 2 == 0) x[0] += 0.1 * random_vector(random);
      const double expected = GetParam().brute(x);
      const double found = GetParam().closest(x).squared_distance;
      const double coordinate_rounding = 1e-15;
      EXPECT_NEAR(std::sqrt(found), std::sqrt(expected), 1e-12 * std::sqrt(expected) + coordinate_rounding)
          << "thickness " << thickness << ": " << to_string(x);
    }
  }
}

TEST_P(Distance, DoesNotDependOnScale) {
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i) {
    const FourPoints x = random_points(random);
    const double here = GetParam().closest(x).squared_distance;
    for (const double scale : {0x1p-60, 0x1p60}) {
      FourPoints scaled = x;
      for (Vector3& point : scaled) point *= scale;
      EXPECT_EQ(GetParam().closest(scaled).squared_distance, here * scale * scale);
    }
  }
}

struct Named {
  const char* name;
  FourPoints x;
  int k;
  double squared_distance;
};

TEST(PointTriangle, ClosedForms) {
  const Vector3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
  for (const Named& n :
       std::initializer_list<Named>{{"above the inside", {Vector3(0.5, 0.5, 3), a, b, c}, 2, 9},
                                    {"below the inside", {Vector3(0.5, 0.5, -3), a, b, c}, 2, 9},
                                    {"on the inside", {Vector3(0.5, 0.5, 0), a, b, c}, 2, 0},
                                    {"beside an edge", {Vector3(1, -1, 1), a, b, c}, 1, 2},
                                    {"above an edge", {Vector3(1, 0, 1), a, b, c}, 1, 1},
                                    {"beyond the long edge", {Vector3(2, 2, 0), a, b, c}, 1, 2},
                                    {"beyond a corner", {Vector3(3, -1, 0), a, b, c}, 0, 2},
                                    {"at a corner", {b, a, b, c}, 0, 0},
                                    {"triangle of no area, beside", {Vector3(0.5, 1, 0), a, Vector3(1, 0, 0), b}, 1, 1},
                                    {"triangle of no area, beyond", {Vector3(4, 0, 0), a, Vector3(1, 0, 0), b}, 0, 4},
                                    {"triangle that is an edge", {Vector3(1, 1, 0), a, a, b}, 1, 1},
                                    {"triangle that is a point", {Vector3(0, 1, 0), b, b, b}, 0, 5},
                                    {"four times one point", {c, c, c, c}, 0, 0}}) {
    const ClosestFeature f = closest_point_triangle(n.x);
    EXPECT_EQ(f.k, n.k) << n.name;
    EXPECT_NEAR(f.squared_distance, n.squared_distance, 1e-15) << n.name;
    expect_consistent(f, n.x);
  }
}

TEST(EdgeEdge, ClosedForms) {
  const Vector3 a(-1, 0, 0), b(1, 0, 0);
  for (const Named& n :
       std::initializer_list<Named>{{"crossing at a height", {a, b, Vector3(0, -1, 2), Vector3(0, 1, 2)}, 2, 4},
                                    {"crossing", {a, b, Vector3(0, -1, 0), Vector3(0, 1, 0)}, 2, 0},
                                    {"end over inside", {a, b, Vector3(0, 1, 0), Vector3(0, 2, 0)}, 1, 1},
                                    {"end to end", {a, b, Vector3(2, 1, 0), Vector3(3, 2, 0)}, 0, 2},
                                    {"parallel, side by side", {a, b, Vector3(-0.5, 1, 0), Vector3(4, 1, 0)}, 1, 1},
                                    {"parallel, one after the other", {a, b, Vector3(3, 1, 0), Vector3(4, 1, 0)}, 0, 5},
                                    {"on one line, overlapping", {a, b, Vector3(0, 0, 0), Vector3(4, 0, 0)}, 1, 0},
                                    {"on one line, apart", {a, b, Vector3(3, 0, 0), Vector3(4, 0, 0)}, 0, 4},
                                    {"first edge a point", {a, a, Vector3(-2, 1, 0), Vector3(2, 1, 0)}, 1, 1},
                                    {"second edge a point", {a, b, Vector3(0, 3, 0), Vector3(0, 3, 0)}, 1, 9},
                                    {"two points", {a, a, b, b}, 0, 4},
                                    {"the same edge twice", {a, b, a, b}, 0, 0}}) {
    const ClosestFeature f = closest_edge_edge(n.x);
    EXPECT_EQ(f.k, n.k) << n.name;
    EXPECT_NEAR(f.squared_distance, n.squared_distance, 1e-15) << n.name;
    expect_consistent(f, n.x);
  }
}

}  // namespace distance_test
}  // namespace tacipc
