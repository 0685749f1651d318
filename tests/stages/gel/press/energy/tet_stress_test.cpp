// Cauchy stress of tetrahedra against closed forms, and against the forces that the solver's own energies give.
#include "stages/gel/press/energy/tet_stress.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/energy/incremental_potential.h"
#include "tests/stages/gel/press/elastic_block.h"

namespace tacipc {
namespace tet_stress_test {

constexpr double kMu = 3e4, kLambda = 2e5;

struct Case {
  ElasticLaw law;
  Element element;
};

class CauchyStress : public ::testing::TestWithParam<Case> {
 protected:
  static SymmetricRows stress_at(const Positions& x) {
    const TetStress second = make_tet_stress(block().rest, block().tets, GetParam().law, GetParam().element);
    return cauchy_stress(*second.body(), x, second(x));
  }
  static const Block& block() {
    static const Block kBlock = make_block({0.02, 0.015, 0.01}, {3, 3, 4}, 0.3);
    return kBlock;
  }
};
INSTANTIATE_TEST_SUITE_P(LawsAndElements, CauchyStress,
                         ::testing::Values(Case{NeoHookean{kMu, kLambda}, Element::linear},
                                           Case{NeoHookean{kMu, kLambda}, Element::averaged_volume},
                                           Case{StvkHencky{kMu, kLambda}, Element::linear},
                                           Case{StvkHencky{kMu, kLambda}, Element::averaged_volume}),
                         [](const auto& test) {
                           return std::string(test.param.law.index() == 0 ? "neo_hookean_" : "stvk_hencky_") +
                                  (test.param.element == Element::linear ? "linear" : "averaged_volume");
                         });

/// By the left stretch alone: B = FFᵀ and its logarithm.
Matrix3 closed_form(const ElasticLaw& law, const Matrix3& F) {
  const double J = F.determinant(), log_J = std::log(J);
  const Matrix3 B = F * F.transpose(), I = Matrix3::Identity();
  if (law.index() == 0) return (kMu * (B - I) + kLambda * log_J * I) / J;
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(B);
  const Matrix3 log_V = 0.5 * eigen.eigenvectors() * eigen.eigenvalues().array().log().matrix().asDiagonal() *
                        eigen.eigenvectors().transpose();
  return (2.0 * kMu * log_V + kLambda * log_J * I) / J;
}

TEST_P(CauchyStress, OfAHomogeneousDeformationIsTheClosedForm) {
  const Matrix3 compressed = Vector3(1.0, 1.0, 0.7).asDiagonal(), stretched = Vector3(1.4, 0.9, 0.95).asDiagonal();
  Matrix3 sheared = Matrix3::Identity();
  sheared(0, 2) = 0.5;
  const Matrix3 turned = Eigen::AngleAxisd(0.8, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Matrix3& F :
       {compressed, stretched, sheared, Matrix3(turned * sheared), Matrix3(turned * compressed * turned.transpose())}) {
    const Positions x = block().rest * F.transpose();
    const SymmetricRows found = stress_at(x);
    const Matrix3 expected = closed_form(GetParam().law, F);
    for (Eigen::Index t = 0; t < found.rows(); ++t)
      ASSERT_LT((symmetric(found, t) - expected).norm(), 1e-11 * expected.norm()) << "tetrahedron " << t << " of\n"
                                                                                  << F;
  }
}

/// Textbook stresses: uniaxial strain λ gives −p along the axis, simple shear γ the stress μ γ.
TEST(CauchyStressByHand, OfUniaxialStrainAndSimpleShear) {
  const Block block = make_block({1, 1, 1}, {1, 1, 1}, 0.0);
  const TetStress second = make_tet_stress(block.rest, block.tets, NeoHookean{2.0, 7.0}, Element::linear);
  const auto first = [&](const Matrix3& F) {
    const Positions x = block.rest * F.transpose();
    return Eigen::Matrix<double, 1, 6>(cauchy_stress(*second.body(), x, second(x)).row(0));
  };
  Matrix3 shear = Matrix3::Identity();
  shear(0, 2) = 0.5;
  const auto of_shear = first(shear);  // B = [1 + γ², 0, γ; 0 1 0; γ 0 1], J = 1
  EXPECT_NEAR(of_shear[0], 2.0 * 0.25, 1e-14);
  EXPECT_NEAR(of_shear[4], 2.0 * 0.5, 1e-14) << "xz";
  for (const int zero : {1, 2, 3, 5}) EXPECT_NEAR(of_shear[zero], 0.0, 1e-14) << zero;
  const auto of_press = first(Vector3(1, 1, 0.8).asDiagonal());
  EXPECT_NEAR(of_press[2], (2.0 * (0.64 - 1.0) + 7.0 * std::log(0.8)) / 0.8, 1e-13);
  EXPECT_NEAR(of_press[0], 7.0 * std::log(0.8) / 0.8, 1e-13);
}

TEST_P(CauchyStress, TurnsWithTheGel) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-4e-4, 4e-4);
  Positions x = block().rest;
  for (double& coordinate : x.reshaped()) coordinate += uniform(random);
  const Matrix3 R = Eigen::AngleAxisd(1.1, Vector3(-1, 2, 0.5).normalized()).toRotationMatrix();
  const SymmetricRows before = stress_at(x), after = stress_at(x * R.transpose());
  for (Eigen::Index t = 0; t < before.rows(); ++t) {
    const Matrix3 expected = R * symmetric(before, t) * R.transpose();
    ASSERT_LT((symmetric(after, t) - expected).norm(), 1e-10 * expected.norm()) << t;
  }
}

/// Σ_t v_t σ_t ∇ₓNᵢ is the derivative of the energy that the solver minimises, whatever the deformation: so σ is what
/// each element carries, also where tetrahedra share a volume.
TEST_P(CauchyStress, GivesTheForcesOfTheEnergy) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-5e-4, 5e-4);
  Positions x = block().rest;
  for (double& coordinate : x.reshaped()) coordinate += uniform(random);
  const SymmetricRows stress = stress_at(x);
  const std::vector<RestTet> now = make_rest_tets(x, block().tets);  // shapes of the deformed tetrahedra
  Positions force = Positions::Zero(x.rows(), 3);
  for (Eigen::Index t = 0; t < stress.rows(); ++t) {
    const RestTet& tet = now[static_cast<std::size_t>(t)];
    const TetCorners corners = tet.volume_m3 * symmetric(stress, t) * tet.shape_gradients;
    for (int k = 0; k < 4; ++k) force.row(block().tets(t, k)) += corners.col(k).transpose();
  }
  const auto energy = make_elasticity(block().rest, block().tets, GetParam().law, GetParam().element);
  Eigen::VectorXd gradient;
  BlockMatrix none = block_matrix_of(*energy, x.rows());
  assemble_all(*energy, x, Order::gradient, gradient, none);
  const Positions expected = gradient.reshaped<Eigen::RowMajor>(x.rows(), 3);
  EXPECT_GT(expected.norm(), 0.1);
  EXPECT_LT((force - expected).norm(), 1e-12 * expected.norm());
}

}  // namespace tet_stress_test
}  // namespace tacipc
