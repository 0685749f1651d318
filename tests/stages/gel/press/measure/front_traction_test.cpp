#include "stages/gel/press/measure/front_traction.h"

#include <gtest/gtest.h>

#include "tests/stages/gel/press/measure/fronts.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace front_traction_test {

/// σ as the row of one tetrahedron.
SymmetricRows row_of(const Matrix3& s, Eigen::Index count) {
  SymmetricRows rows(count, 6);
  rows.rowwise() = Eigen::Matrix<double, 1, 6>(s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(0, 2), s(0, 1));
  return rows;
}

TEST(FrontTraction, OfAUniformStressIsExactOnAFlatFront) {
  Positions x;
  const FrontSurface front = square_front(6, 0.01, 0.3, x);
  const std::vector<int> behind(static_cast<std::size_t>(front.triangles.rows()), 0);
  const Matrix3 stress{{-100, 7, 20}, {7, -50, -30}, {20, -30, -4000}};
  const Matrix3 tilt = Eigen::AngleAxisd(0.4, Vector3(1, 2, 0).normalized()).toRotationMatrix();
  for (const Matrix3& R : {Matrix3(Matrix3::Identity()), tilt}) {
    const FrontTraction found =
        traction_of_stress(front, x * R.transpose(), row_of(R * stress * R.transpose(), 1), behind);
    const Vector3 shear = R * Vector3(20, -30, 0);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      EXPECT_NEAR(found.pressure[v], 4000.0, 1e-9) << v;
      EXPECT_LT((found.shear.row(v).transpose() - shear).norm(), 1e-9) << v;
    }
  }
}

/// Forces that are the integrals of a uniform traction over each vertex's third of the triangles.
TEST(FrontTraction, OfForcesIsForceOverArea) {
  Positions x;
  const FrontSurface front = square_front(5, 0.01, 0.25, x);
  const std::vector<double> areas = lumped_areas(front, x);
  Positions force(x.rows(), 3);
  for (Eigen::Index v = 0; v < x.rows(); ++v)
    force.row(v) = areas[static_cast<std::size_t>(v)] * Eigen::RowVector3d(300, -200, -9000);
  const FrontTraction found = traction_of_forces(front, x, force);
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    EXPECT_NEAR(found.pressure[v], 9000.0, 1e-8);
    EXPECT_LT((found.shear.row(v) - Eigen::RowVector3d(300, -200, 0)).norm(), 1e-8);
  }
}

/// On a dome hydrostatic stress is pressure alone, to the second order in the triangles' edges.
TEST(FrontTraction, OnADomePressureIsPressureAlone) {
  double error_before = 0.0;
  for (const int n : {8, 16, 32}) {
    Positions x;
    const FrontSurface front = square_front(n, 0.01, 0.0, x, 0.02);
    const FrontTraction found =
        traction_of_stress(front, x, row_of(-5000.0 * Matrix3::Identity(), 1),
                           std::vector<int>(static_cast<std::size_t>(front.triangles.rows()), 0));
    double error = 0.0;
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      error = std::max(error, std::abs(found.pressure[v] - 5000.0));
      EXPECT_LT(found.shear.row(v).norm(), 1e-8);
    }
    if (error_before > 0.0) {
      EXPECT_NEAR(std::log2(error_before / error), 2.0, 0.2) << n;
    }
    error_before = error;
  }
}

TEST(FrontTraction, FindsTheTetrahedronBehindEachTriangle) {
  const TetMesh gel = block_gel(3, 0.01, 0.002);
  const FrontSurface front = make_front_surface(gel);
  const std::vector<int> behind = tets_behind(front, gel.tets);
  ASSERT_EQ(behind.size(), 18u);
  for (std::size_t f = 0; f < behind.size(); ++f) {
    for (int c = 0; c < 3; ++c) {
      const int vertex = front.vertices[static_cast<std::size_t>(front.triangles(static_cast<Eigen::Index>(f), c))];
      EXPECT_TRUE((gel.tets.row(behind[f]).array() == vertex).any()) << f;
    }
  }
}

}  // namespace front_traction_test
}  // namespace tacipc
