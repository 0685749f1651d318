#include "stages/gel/press/contact/intersection_check.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "common/base/error.h"
#include "common/mesh/exact_predicates.h"
#include "tests/stages/gel/press/contact/random_points.h"

namespace tacipc {
namespace intersection_check_test {

struct Mesh {
  Positions positions;
  Triangles triangles;
  operator SurfaceView() const { return {positions, triangles}; }
};

/// Closed sphere of quads cut in two between circles of latitude; the poles are fans.
Mesh sphere(int rings, const Vector3& centre, double radius, const Matrix3& turn) {
  const int around = 2 * rings;
  Mesh mesh{Positions(2 + (rings - 1) * around, 3), Triangles(2 * around * (rings - 1), 3)};
  const auto put = [&](int row, const Vector3& p) {
    mesh.positions.row(row) = (centre + radius * (turn * p)).transpose();
  };
  put(0, {0, 0, 1});
  put(1, {0, 0, -1});
  const auto index = [&](int ring, int k) { return 2 + (ring - 1) * around + k % around; };
  int row = 0;
  for (int ring = 1; ring < rings; ++ring)
    for (int k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * ring / rings, azimuth = 2 * std::numbers::pi * k / around;
      put(index(ring, k), {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)});
      if (ring == 1) mesh.triangles.row(row++) << 0, index(1, k), index(1, k + 1);
      if (ring == rings - 1) {
        mesh.triangles.row(row++) << 1, index(ring, k + 1), index(ring, k);
      } else {
        mesh.triangles.row(row++) << index(ring, k), index(ring + 1, k), index(ring + 1, k + 1);
        mesh.triangles.row(row++) << index(ring, k), index(ring + 1, k + 1), index(ring, k + 1);
      }
    }
  return mesh;
}

const Matrix3 kTurn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
const Mesh kNothing{Positions(0, 3), Triangles(0, 3)};

TrianglePoints corners(const Mesh& mesh, int t) {
  TrianglePoints p;
  for (int i = 0; i < 3; ++i) p[i] = mesh.positions.row(mesh.triangles(t, i)).transpose();
  return p;
}

TEST(FindIntersections, ClosedSpheresApartAreClean) {
  for (const Matrix3& turn : {Matrix3(Matrix3::Identity()), kTurn}) {
    const Mesh gel = sphere(20, {0, 0, 0}, 1, turn);
    EXPECT_EQ(count_self_intersections(gel), 0);
    EXPECT_EQ(count_intersections(gel, sphere(20, {2.001, 0, 0}, 1, kTurn)), 0);
    EXPECT_EQ(count_intersections(gel, sphere(20, {0, 0, 0}, 0.9, kTurn)), 0) << "one inside the other";
  }
}

TEST(FindIntersections, CountsWhatTestingAllPairsCounts) {
  const Mesh gel = sphere(12, {0, 0, 0}, 1, kTurn);
  const Mesh object = sphere(10, {1.2, 0.3, 0.4}, 0.8, Matrix3::Identity());
  std::int64_t expected = 0;
  for (int i = 0; i < gel.triangles.rows(); ++i)
    for (int j = 0; j < object.triangles.rows(); ++j)
      expected += triangles_intersect(corners(gel, i), corners(object, j));
  ASSERT_GT(expected, 20);
  EXPECT_EQ(count_intersections(gel, object), expected);
}

TEST(FindIntersections, SeesTwoPartsOfTheGelThatCross) {
  Mesh gel = sphere(8, {0, 0, 0}, 1, kTurn);
  const Mesh other = sphere(8, {1.5, 0, 0}, 1, Matrix3::Identity());
  const std::int64_t crossings = count_intersections(gel, other);
  ASSERT_GT(crossings, 0);
  const Eigen::Index vertices = gel.positions.rows(), triangles = gel.triangles.rows();
  gel.positions.conservativeResize(vertices + other.positions.rows(), 3);
  gel.positions.bottomRows(other.positions.rows()) = other.positions;
  gel.triangles.conservativeResize(triangles + other.triangles.rows(), 3);
  gel.triangles.bottomRows(other.triangles.rows()) = other.triangles.array() + static_cast<int>(vertices);
  EXPECT_EQ(count_self_intersections(gel), crossings);
}

TEST(FindIntersections, NeighboursIntersectOnlyBeyondWhatTheyShare) {
  // Vertices: a fan around 0, then its variations.
  Mesh mesh{Positions(6, 3), Triangles(2, 3)};
  mesh.positions << 0, 0, 0, 4, 0, 0, 0, 4, 0, -4, 0, 0, 2, 2, 2, 1, 1, 0;
  const auto gel_gel = [&](std::array<int, 3> a, std::array<int, 3> b) {
    mesh.triangles << a[0], a[1], a[2], b[0], b[1], b[2];
    return count_self_intersections(mesh);
  };
  EXPECT_EQ(gel_gel({0, 1, 2}, {0, 2, 3}), 0) << "flat neighbours";
  EXPECT_EQ(gel_gel({0, 1, 2}, {1, 0, 4}), 0) << "bent neighbours";
  EXPECT_EQ(gel_gel({0, 1, 2}, {5, 2, 1}), 1) << "folded flat over the common edge";
  EXPECT_EQ(gel_gel({0, 1, 2}, {0, 3, 4}), 0) << "one common vertex, nothing else";
  EXPECT_EQ(gel_gel({0, 1, 2}, {0, 5, 4}), 1) << "one common vertex, and the edge from it lies inside";
  EXPECT_EQ(gel_gel({0, 1, 2}, {2, 0, 1}), 1) << "the same triangle twice";
  EXPECT_EQ(gel_gel({0, 1, 2}, {5, 3, 4}), 1) << "a corner touching the inside";
}

TEST(FindIntersections, OneVertexPushedThroughIsFound) {
  const Mesh gel = sphere(20, {0, 0, 0}, 1, kTurn);
  Mesh object = sphere(20, {2.1, 0, 0}, 1, kTurn);
  Eigen::Index nearest;
  object.positions.col(0).minCoeff(&nearest);
  object.positions(nearest, 0) = 0.9;
  EXPECT_GT(count_intersections(gel, object), 0);
}

TEST(FindIntersections, NamesWhatIsWrongWithTheInput) {
  const auto message = [](const Mesh& gel, const Mesh& object) -> std::string {
    try {
      count_intersections(gel, object);
    } catch (const DataError& error) {
      return error.what();
    }
    return "nothing";
  };
  Mesh mesh = sphere(4, {0, 0, 0}, 1, kTurn);
  mesh.triangles(3, 1) = 99;
  EXPECT_EQ(message(mesh, kNothing), "gel triangle 3 refers to vertex 99, but there are 26 vertices");
  EXPECT_EQ(message(kNothing, mesh), "object triangle 3 refers to vertex 99, but there are 26 vertices");
  mesh = sphere(4, {0, 0, 0}, 1, kTurn);
  mesh.positions(mesh.triangles(0, 0), 2) = std::nan("");
  EXPECT_EQ(message(kNothing, mesh), "object triangle 0: vertex 0 has a coordinate that is not finite");
}

TEST(CountInvertedTets, CountsNegativeAndFlatOnes) {
  Positions x(5, 3);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5, 0.5, 0;
  Tetrahedra tets(3, 4);
  tets << 0, 1, 2, 3, 1, 0, 2, 3, 0, 1, 2, 4;
  EXPECT_EQ(count_inverted_tets(x, tets), 2);
  x(4, 2) = 1e-300;
  EXPECT_EQ(count_inverted_tets(x, tets), 1);
}

TEST(WindingNumber, TellsTheInsideOfAClosedSurface) {
  const Vector3 centre(0.3, -0.2, 0.1);
  const Mesh ball = sphere(6, centre, 1.0, kTurn);
  EXPECT_NEAR(winding_number(centre, ball), 1.0, 1e-12);
  EXPECT_NEAR(winding_number(centre + Vector3(0.6, 0.5, -0.3), ball), 1.0, 1e-12);
  EXPECT_NEAR(winding_number(centre + Vector3(1.01, 0.0, 0.0), ball), 0.0, 1e-12);
  EXPECT_NEAR(winding_number(centre + Vector3(20.0, 3.0, 7.0), ball), 0.0, 1e-12);
  Mesh turned = ball;
  turned.triangles.col(0).swap(turned.triangles.col(1));
  EXPECT_NEAR(winding_number(centre, turned), -1.0, 1e-12);
}

}  // namespace intersection_check_test
}  // namespace tacipc
