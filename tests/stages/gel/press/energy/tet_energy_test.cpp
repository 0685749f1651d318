// The material laws over deformation gradients: values by hand, Hooke's limit, and their negative modes.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <random>

#include "stages/gel/press/energy/tet_energy.h"
#include "tests/stages/gel/press/convergence_order.h"

namespace tacipc {
namespace tet_energy_test {

using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// ψ(F) as the laws' headers have it.
double energy_density(const ElasticLaw& law, const Matrix3& F) {
  const double J = F.determinant();
  if (!(J > 0.0)) return std::numeric_limits<double>::infinity();
  if (const auto* stvk = std::get_if<StvkHencky>(&law)) return stvk->principal_energy(principal_stretches(F).sigma);
  const auto [mu, lambda] = std::get<NeoHookean>(law);
  return 0.5 * mu * (F.squaredNorm() - 3.0) - mu * std::log(J) + 0.5 * lambda * std::log(J) * std::log(J);
}
Matrix3 stress(const ElasticLaw& law, const Matrix3& F) {
  return std::visit([&](const auto& l) { return l.stress(F); }, law);
}

class LawTest : public ::testing::TestWithParam<ElasticLaw> {};
INSTANTIATE_TEST_SUITE_P(Laws, LawTest, ::testing::Values(NeoHookean{2.0, 7.0}, StvkHencky{2.0, 7.0}),
                         [](const auto& test) { return test.param.index() == 0 ? "neo_hookean" : "stvk_hencky"; });

Matrix3 random_gradient(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-0.45, 0.45);
  while (true) {
    Matrix3 F = Matrix3::Identity() * size;
    for (double& entry : F.reshaped()) entry += uniform(random);
    if (F.determinant() > 0.05) return F;
  }
}

TEST_P(LawTest, StressIsTheEnergysDerivative) {
  std::mt19937 random(3);
  for (const double size : {0.8, 1.3}) {
    const Matrix3 F = random_gradient(random, size), d = random_gradient(random, 0.5);
    const double exact = stress(GetParam(), F).cwiseProduct(d).sum();
    const auto error = [&](double h) {
      return std::abs((energy_density(GetParam(), F + h * d) - energy_density(GetParam(), F - h * d)) / (2 * h) -
                      exact);
    };
    EXPECT_NEAR(convergence_order(error, 4e-3), 2.0, 0.1);
  }
}

TEST_P(LawTest, SmallStrainIsHookesLaw) {
  Matrix3 strain;
  strain << 1, 0.5, -0.2, 0.5, -0.7, 0.3, -0.2, 0.3, 0.4;
  strain *= 1e-6;
  const Matrix3 hooke = 2.0 * 2.0 * strain + 7.0 * strain.trace() * Matrix3::Identity();
  EXPECT_LT((stress(GetParam(), Matrix3::Identity() + strain) - hooke).norm(), 1e-5 * hooke.norm());
}

TEST_P(LawTest, ATurnCostsNothingAndNothingTurnsInsideOut) {
  std::mt19937 random(5);
  const Matrix3 R = Eigen::AngleAxisd(2.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Matrix3 F = random_gradient(random, 1.1);
  EXPECT_LT(energy_density(GetParam(), R), 1e-28);
  EXPECT_NEAR(energy_density(GetParam(), R * F), energy_density(GetParam(), F), 1e-13);
  EXPECT_NEAR(energy_density(GetParam(), F * R), energy_density(GetParam(), F), 1e-13);
  EXPECT_TRUE(std::isinf(energy_density(GetParam(), -Matrix3::Identity())));
  EXPECT_TRUE(std::isinf(energy_density(GetParam(), Vector3(1, 1, 0).asDiagonal())));
}

/// The 9 × 9 Hessian of ψ + p J as tet_energy has it: a corner tetrahedron's last three vertices move like the columns
/// of F, and its volume is 1/6.
Matrix9 tet_hessian(const ElasticLaw& law, const Matrix3& F, double p, Order order) {
  const RestTet tet =
      make_rest_tets(Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Tetrahedra{{0, 1, 2, 3}})[0];
  TetCorners x = TetCorners::Zero();
  x.rightCols<3>() = F;
  Vector12 gradient;
  Matrix12 hessian;
  tet_energy(law, tet, TetPoints(x.data()), p, order, {gradient.data(), hessian.data()});
  return 6.0 * hessian.bottomRightCorner<9, 9>();
}

/// The same by central differences of the stress, good to about 1e-9 of it.
Matrix9 numeric_hessian(const ElasticLaw& law, const Matrix3& F, double p) {
  const auto first = [&](const Matrix3& at) -> Matrix3 {
    return stress(law, at) + p * at.determinant() * at.inverse().transpose();
  };
  Matrix9 H;
  for (int k = 0; k < 9; ++k) {
    Matrix3 d = Matrix3::Zero();
    d.reshaped()[k] = 1e-5;
    H.col(k) = ((first(F + d) - first(F - d)) / 2e-5).reshaped();
  }
  return 0.5 * (H + H.transpose());
}

TEST_P(LawTest, ClosedFormProjectionIsTheEigenvalueProjectionOfTheHessian) {
  std::mt19937 random(7);
  int negative = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Matrix3 F = random_gradient(random, trial % 2 ? 0.8 : 1.3);
    const double p = trial % 3 == 0 ? 0.0 : trial % 3 == 1 ? 5.0 : -5.0;
    const Matrix9 H = tet_hessian(GetParam(), F, p, Order::hessian);
    EXPECT_LT((H - numeric_hessian(GetParam(), F, p)).norm(), 1e-6 * H.norm()) << "p = " << p << ", F =\n" << F;
    const Eigen::SelfAdjointEigenSolver<Matrix9> eigen(H);
    const Matrix9 expected =
        eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
    EXPECT_LT((tet_hessian(GetParam(), F, p, Order::psd) - expected).norm(), 1e-9 * H.norm())
        << "p = " << p << ", F =\n"
        << F;
    negative += eigen.eigenvalues()[0] < -1e-9 * H.norm();
  }
  EXPECT_GT(negative, 100);
}

TEST(NeoHookean, UniaxialStretchByHand) {
  const Matrix3 F = Vector3(1, 1, 2).asDiagonal();
  const double log_2 = std::log(2.0);
  EXPECT_NEAR(energy_density(NeoHookean{2.0, 7.0}, F), 3.0 - 2.0 * log_2 + 3.5 * log_2 * log_2, 1e-14);
  EXPECT_NEAR((NeoHookean{2.0, 7.0}.stress(F)(2, 2)), 4.0 - 1.0 + 3.5 * log_2, 1e-14);
}

TEST(StvkHencky, StretchByHand) {
  const Matrix3 F = Vector3(0.5, 1, 2).asDiagonal();  // ln J = 0
  const double log_2 = std::log(2.0);
  EXPECT_NEAR(energy_density(StvkHencky{2.0, 7.0}, F), 4.0 * log_2 * log_2, 1e-14);
  EXPECT_NEAR(energy_density(StvkHencky{2.0, 7.0}, 2.0 * Matrix3::Identity()), (6.0 + 31.5) * log_2 * log_2, 1e-13);
  EXPECT_NEAR((StvkHencky{2.0, 7.0}.stress(F)(2, 2)), 2.0 * log_2, 1e-14);
  EXPECT_NEAR((StvkHencky{2.0, 7.0}.stress(F)(0, 0)), -8.0 * log_2, 1e-14);
}

/// Equal and all but equal stretches are where a difference quotient loses its digits.
TEST(StvkHencky, HessianIsExactForEqualAndNearlyEqualStretches) {
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3(1, 2, -2) / 3.0).toRotationMatrix();
  const Matrix3 Q = Eigen::AngleAxisd(-1.9, Vector3(2, -1, 2) / 3.0).toRotationMatrix();
  const StvkHencky law{2.0, 7.0};
  for (const double s : {1.0, 0.3, 2.5}) {
    // All equal: δσ of the law, δP = 2μ/s² sym-like and the rest in closed form with ε = ln s, π = 2με + 3λε.
    const double e = std::log(s), pi = 2.0 * 2.0 * e + 3.0 * 7.0 * e;
    const Matrix9 equal = tet_hessian(law, s * R, 0.0, Order::hessian);
    for (int k = 0; k < 9; ++k) {
      Matrix3 d = Matrix3::Zero();
      d.reshaped()[k] = 1.0;
      const Matrix3 w = R.transpose() * d, symmetric = 0.5 * (w + w.transpose()), skew = 0.5 * (w - w.transpose());
      const Matrix3 expected =
          R * ((4.0 - pi) * symmetric + pi * skew + 7.0 * w.trace() * Matrix3::Identity()) / (s * s);
      EXPECT_LT((equal.col(k) - expected.reshaped()).norm(), 1e-13 * equal.norm()) << s;
    }
    // Nearly equal: the Hessian is smooth in F, so it can only differ by as much as F does.
    for (const double apart : {1e-2, 1e-5, 1e-8, 1e-11, 1e-14, 1e-16}) {
      const Vector3 stretches(s * (1.0 + apart), s, s * (1.0 - 0.7 * apart));
      const Matrix9 near = tet_hessian(law, R * Q * stretches.asDiagonal() * Q.transpose(), 0.0, Order::hessian);
      EXPECT_LT((near - equal).norm(), (10.0 * apart + 1e-13) * equal.norm()) << s << " " << apart;
    }
  }
}

TEST(PrincipalStretches, AreRotationsAndStretchesOfFlatAndPlainGradients) {
  std::mt19937 random(9);
  const Matrix3 R = Eigen::AngleAxisd(0.7, Vector3(1, 2, -2) / 3.0).toRotationMatrix();
  const Matrix3 Q = Eigen::AngleAxisd(-1.9, Vector3(2, -1, 2) / 3.0).toRotationMatrix();
  const Matrix3 flat = R * Vector3(1.5, 1e-9, 2.0).asDiagonal() * Q;
  for (const Matrix3& F : {Matrix3(Matrix3::Identity()), R, random_gradient(random, 1.0), flat}) {
    const PrincipalStretches s = principal_stretches(F);
    EXPECT_LT((s.U * s.sigma.asDiagonal() * s.V.transpose() - F).norm(), 1e-14 * F.norm());
    EXPECT_LT((s.U.transpose() * s.U - Matrix3::Identity()).norm(), 1e-14);
    EXPECT_LT((s.V.transpose() * s.V - Matrix3::Identity()).norm(), 1e-14);
    EXPECT_GT(s.V.determinant(), 0.0);
  }
  // The small stretch can only be as good as F's rounding leaves it.
  EXPECT_NEAR(principal_stretches(flat).sigma.minCoeff(), 1e-9, 1e-15);
}

}  // namespace tet_energy_test
}  // namespace tacipc
