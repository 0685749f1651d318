// Derivatives by differences are in energy_term_test.
#include "stages/gel/press/energy/orthogonality.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <vector>

#include "tests/make_mesh.h"

namespace tacipc {
namespace orthogonality_test {

/// A cube of 20 mm about the origin.
constexpr double kSide = 0.02, kVolume = kSide * kSide * kSide;
const TriangleMesh& cube() {
  static const TriangleMesh kMesh = make_box(Vector3::Constant(-0.5 * kSide), Vector3::Constant(0.5 * kSide));
  return kMesh;
}
AffineBody cube_body() { return make_affine_body(cube().positions, cube().triangles, 8000.0); }

Eigen::VectorXd coordinates(const ControlPoints& control) { return control.reshaped<Eigen::RowMajor>(); }

Eigen::VectorXd deformed(const AffineBody& body, const Matrix3& A, const Vector3& shift = Vector3::Zero()) {
  return coordinates((body.rest_m * A.transpose()).rowwise() + shift.transpose());
}

Local evaluated(const Orthogonality& term, const Eigen::VectorXd& x, Order order) {
  Local local;
  term.evaluate(0, x, order, local);
  return local;
}

TEST(Orthogonality, ActsOnTheFourControlPoints) {
  const Orthogonality term(7, cube_body());
  ASSERT_EQ(term.num_stencils(), 1);
  const std::span<const int> stencil = term.stencil(0);
  EXPECT_EQ(std::vector<int>(stencil.begin(), stencil.end()), (std::vector<int>{7, 8, 9, 10}));
}

TEST(Orthogonality, VanishesForRigidMotions) {
  const AffineBody body = cube_body();
  const Orthogonality term(0, body);
  for (const double angle : {0.0, 0.4, 1.7, 3.1}) {
    const Matrix3 R = Eigen::AngleAxisd(angle, Vector3(1, 2, -1).normalized()).toRotationMatrix();
    const Local local = evaluated(term, deformed(body, R, {0.3, -0.5, 0.2}), Order::gradient);
    EXPECT_LT(local.value, 1e-22) << angle;
    EXPECT_LT(local.gradient.norm(), 1e-6) << angle;  // N; one millionth of strain makes 400 N
  }
}

TEST(Orthogonality, StretchByHand) {
  const AffineBody body = cube_body();
  const Orthogonality term(0, body, 3e5);
  const double e = 0.1;
  const Eigen::VectorXd x = deformed(body, Vector3(1.0 + e, 1.0, 1.0).asDiagonal());
  EXPECT_NEAR(evaluated(term, x, Order::value).value, 3e5 * kVolume * std::pow(2 * e + e * e, 2), 1e-14);
}

/// Stress σ = 8κ ε for small strains, shear included: Young's modulus 8κ and Poisson's ratio 0. A uniform stress is the
/// forces V σ gₖ on the control points.
TEST(Orthogonality, IsASolidOfModulusEightKappaAndPoissonRatioZero) {
  const AffineBody body = cube_body();
  Matrix3 strain;
  strain << 3, 1, -2, 1, -1, 0.5, -2, 0.5, 2;
  strain *= 1e-7;
  const Eigen::VectorXd x = deformed(body, Matrix3::Identity() + strain);
  const Local local = evaluated(Orthogonality(0, body), x, Order::gradient);
  const ControlPoints expected = kVolume * 8.0 * kOrthogonalityPa * weight_gradients(body) * strain;
  EXPECT_LT((local.gradient - coordinates(expected)).norm(), 2e-6 * expected.norm());  // next order of the strain
  const double energy = 0.5 * 8.0 * kOrthogonalityPa * kVolume * strain.squaredNorm();
  EXPECT_NEAR(local.value, energy, 2e-6 * energy);
}

/// ±10 N on two opposite faces of a cube of 20 mm: strain f a / (8 κ V) = 3.125·10⁻⁵ at κ = 10⁸ Pa.
TEST(Orthogonality, CubeUnderTenNewtonsIsStrainedByThreeInAHundredThousand) {
  const AffineBody body = cube_body();
  const Orthogonality term(0, body);
  Positions forces = Positions::Zero(8, 3);
  for (Eigen::Index v = 0; v < 8; ++v) forces(v, 0) = cube().positions(v, 0) > 0.0 ? 2.5 : -2.5;
  const Eigen::VectorXd load = coordinates(body.weights.transpose() * forces);
  Eigen::VectorXd x = coordinates(body.rest_m);
  for (int i = 0; i < 4; ++i) {
    const Local local = evaluated(term, x, Order::hessian);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;  // least norm: rigid motions stay out
    solver.setThreshold(1e-6);
    solver.compute(local.hessian);
    x += solver.solve(load - local.gradient);
  }
  const Local solved = evaluated(term, x, Order::gradient);
  EXPECT_LT((solved.gradient - load).norm(), 1e-6 * load.norm());
  const ControlPoints control = x.reshaped<Eigen::RowMajor>(4, 3);
  EXPECT_NEAR(0.5 * strain_of(body, control), 3.125e-5, 2e-3 * 3.125e-5);
  const Positions moved = body.weights * control - cube().positions;
  EXPECT_NEAR(moved.col(0).maxCoeff() - moved.col(0).minCoeff(), 0.625e-6, 2e-3 * 0.625e-6);
}

/// Squeezed along all axes it gives way to turning and bulging; the stand-in removes just that.
TEST(Orthogonality, StandInForTheHessianIsTheNearestOne) {
  const AffineBody body = cube_body();
  const Orthogonality term(0, body);
  const Eigen::VectorXd x = deformed(body, Vector3(0.7, 0.8, 0.6).asDiagonal());
  const Matrix12 exact = evaluated(term, x, Order::hessian).hessian, psd = evaluated(term, x, Order::psd).hessian;
  const Eigen::SelfAdjointEigenSolver<Matrix12> of_exact(exact), of_psd(psd);
  const double scale = of_exact.eigenvalues()[11];
  EXPECT_LT(of_exact.eigenvalues()[0], -0.01 * scale);
  EXPECT_LT((of_psd.eigenvalues() - of_exact.eigenvalues().cwiseMax(0.0)).norm(), 1e-12 * scale);
  const Matrix12 removed = psd - exact;
  const double negative = of_exact.eigenvalues().cwiseMin(0.0).norm();
  EXPECT_NEAR(removed.norm(), negative, 1e-12 * scale);
  // Away from compression nothing is removed.
  const Eigen::VectorXd stretched = deformed(body, Vector3(1.2, 1.1, 1.3).asDiagonal());
  const Matrix12 kept = evaluated(term, stretched, Order::psd).hessian;
  EXPECT_LT((kept - evaluated(term, stretched, Order::hessian).hessian).norm(), 1e-12 * kept.norm());
}

}  // namespace orthogonality_test
}  // namespace tacipc
