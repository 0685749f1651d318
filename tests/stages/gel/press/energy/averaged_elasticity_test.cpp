// Patches of tetrahedra, and the element that shares its volume over them.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "stages/gel/press/energy/averaged_elasticity.h"
#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/element.h"
#include "tests/stages/gel/press/dense_derivatives.h"
#include "tests/stages/gel/press/elastic_block.h"

namespace tacipc {
namespace averaged_elasticity_test {

/// Young's modulus 1 Pa.
NeoHookean rubber(double poissons_ratio) {
  return {1.0 / (2.0 * (1.0 + poissons_ratio)),
          poissons_ratio / ((1.0 + poissons_ratio) * (1.0 - 2.0 * poissons_ratio))};
}

/// The block's vertices, moved about.
Positions crumpled(const Block& block) {
  Positions x = block.rest;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double t = static_cast<double>(v);
    x.row(v) += 0.05 * Vector3(std::sin(3.0 * t), std::cos(5.0 * t), std::sin(2.0 + t)).transpose();
  }
  return x;
}

Eigen::MatrixXd dense_hessian(const EnergyTerm& term, const Positions& x, Order order) {
  return dense_derivatives(term, x, order).hessian;
}

/// ∂(volume)/∂x of a tetrahedron at each of its corners: a third of the opposite face's area, inwards.
void add_volume_gradient(const Positions& x, const auto& tet, Eigen::VectorXd& gradient) {
  const auto corner = [&](int k) -> Vector3 { return x.row(tet[k]); };
  const auto add = [&](int k, const Vector3& twice_area) { gradient.segment<3>(3 * tet[k]) += twice_area / 6.0; };
  add(1, (corner(2) - corner(0)).cross(corner(3) - corner(0)));
  add(2, (corner(3) - corner(0)).cross(corner(1) - corner(0)));
  add(3, (corner(1) - corner(0)).cross(corner(2) - corner(0)));
  add(0, (corner(3) - corner(1)).cross(corner(2) - corner(1)));
}

TEST(AveragedElasticity, PatchesOfOneAreTheLinearElement) {
  const Block block = make_block({1, 1, 1}, {2, 2, 2}, 0.2);
  const Positions x = crumpled(block);
  for (const ElasticLaw& law : {ElasticLaw(NeoHookean{2.0, 7.0}), ElasticLaw(StvkHencky{2.0, 7.0})}) {
    const Elasticity linear(block.rest, block.tets, law);
    const AveragedElasticity averaged(block.rest, block.tets, law, make_tet_clusters(block.tets, 1));
    ASSERT_EQ(linear.num_stencils(), averaged.num_stencils());
    Eigen::VectorXd a, b;
    BlockMatrix A = block_matrix_of(linear, x.rows()), B = A;
    const double value = assemble_all(linear, x, Order::hessian, a, A);
    EXPECT_NEAR(assemble_all(averaged, x, Order::hessian, b, B), value, 1e-13 * value);
    EXPECT_LT((a - b).norm(), 1e-13 * a.norm());
    double difference = 0.0, size = 0.0;
    for (std::size_t k = 0; k < A.values.size(); ++k) {
      difference = std::max(difference, std::abs(A.values[k] - B.values[k]));
      size = std::max(size, std::abs(A.values[k]));
    }
    EXPECT_LT(difference, 1e-13 * size);
  }
}

TEST(AveragedElasticity, CubeStretchedByHand) {
  // F is the same everywhere, so averaging changes nothing: ψ = μ/2 (λ² − 1) − μ ln λ + λ/2 (ln λ)² at stretch 2.
  const Block block = make_block({1, 1, 1}, {1, 1, 1}, 0.0);
  const AveragedElasticity term(block.rest, block.tets, NeoHookean{2.0, 7.0}, TetClusters{{0, 1, 2, 3, 4, 5}});
  Positions x = block.rest;
  x.col(2) *= 2.0;
  Eigen::VectorXd gradient;
  BlockMatrix hessian = block_matrix_of(term, x.rows());
  const double log_2 = std::log(2.0);
  EXPECT_NEAR(assemble_all(term, x, Order::value, gradient, hessian), 3.0 - 2.0 * log_2 + 3.5 * log_2 * log_2, 1e-14);
  x.row(0) << 2, 2, 2;  // inverts a tetrahedron
  EXPECT_TRUE(std::isinf(assemble_all(term, x, Order::value, gradient, hessian)));
}

/// Volume may be exchanged inside a cluster at the price of shape alone, however incompressible the material.
TEST(AveragedElasticity, OnlyThePatchsVolumeIsStiff) {
  const Block block = make_block({1, 1, 1}, {1, 1, 1}, 0.0);
  const TetClusters one{{0, 1, 2, 3, 4, 5}};
  const auto stiffness = [&](double lambda) {
    const AveragedElasticity term(block.rest, block.tets, NeoHookean{1.0, lambda}, one);
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense_hessian(term, block.rest, Order::hessian))
        .eigenvalues()
        .eval();
  };
  const Eigen::VectorXd soft = stiffness(1.0), stiff = stiffness(1e6);
  EXPECT_GT(stiff[23], 1e5);
  EXPECT_LT(stiff[22], 10.0 * soft[22]);  // one stiff mode
}

/// At rest the averaged energy lies between that of the linear element without λ and with it (averaging takes away, and
/// never more than all), so every eigenvalue does too: no motion but a rigid one is free, and no soft mode is new.
TEST(AveragedElasticity, HasNoSoftModesBesideThoseOfTheLinearElement) {
  for (const int cells : {2, 4}) {
    const Block block = make_block({1, 1, 1}, {cells, cells, cells}, 0.2);
    const auto spectrum = [&](Element element, const NeoHookean& law) {
      const auto term = make_elasticity(block.rest, block.tets, law, element);
      return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense_hessian(*term, block.rest, Order::hessian),
                                                            Eigen::EigenvaluesOnly)
          .eigenvalues()
          .eval();
    };
    const NeoHookean law = rubber(0.3);
    const Eigen::VectorXd linear = spectrum(Element::linear, law), averaged = spectrum(Element::averaged_volume, law),
                          bare = spectrum(Element::linear, {law.mu_pa, 0.0});
    EXPECT_LT(std::abs(averaged[5]), 1e-12);
    for (Eigen::Index k = 6; k < linear.size(); ++k) {
      EXPECT_GT(averaged[k], (1.0 - 1e-9) * bare[k]) << k;
      EXPECT_LT(averaged[k], (1.0 + 1e-9) * linear[k]) << k;
    }
    // Towards incompressibility the shear modulus falls from 0.385 to 0.333; the softest mode follows it and no more.
    EXPECT_GT(spectrum(Element::averaged_volume, rubber(0.4999))[6], 0.8 * averaged[6]);
  }
}

/// At rest λ acts on each cluster's volume V alone: the Hessian is that without λ and λ/V ∇V ∇Vᵀ of every cluster.
TEST(AveragedElasticity, HessianAtRestIsThatOfShapeAndOfEachClustersVolume) {
  const Block block = make_block({3, 2, 1}, {3, 2, 2}, 0.2);
  const TetClusters clusters = make_tet_clusters(block.tets, kClusterSize);
  ASSERT_GT(clusters.size(), 3u);
  for (const double nu : {0.3, 0.4999}) {
    const NeoHookean law = rubber(nu);
    Eigen::MatrixXd expected =
        dense_hessian(Elasticity(block.rest, block.tets, NeoHookean{law.mu_pa, 0.0}), block.rest, Order::hessian);
    for (const auto& cluster : clusters) {
      Eigen::VectorXd gradient = Eigen::VectorXd::Zero(3 * block.rest.rows());
      for (const int t : cluster) add_volume_gradient(block.rest, block.tets.row(t), gradient);
      const double volume = gradient.dot(block.rest.reshaped<Eigen::RowMajor>()) / 3.0;
      expected += law.lambda_pa / volume * gradient * gradient.transpose();
    }
    const auto term = make_elasticity(block.rest, block.tets, law, Element::averaged_volume);
    EXPECT_LT((dense_hessian(*term, block.rest, Order::hessian) - expected).norm(), 1e-12 * expected.norm()) << nu;
  }
}

TEST(AveragedElasticity, StandInHasNoNegativeEigenvalueWhereTheHessianHasMany) {
  const Block block = make_block({1, 1, 1}, {2, 2, 2}, 0.2);
  Positions x = crumpled(block);
  x.col(2) *= 0.6;
  for (const ElasticLaw& law : {ElasticLaw(rubber(0.4999)), ElasticLaw(StvkHencky{0.333, 1666.0})}) {
    const auto term = make_elasticity(block.rest, block.tets, law, Element::averaged_volume);
    const Eigen::MatrixXd H = dense_hessian(*term, x, Order::hessian), P = dense_hessian(*term, x, Order::psd);
    EXPECT_LT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H).eigenvalues()[0], -1e-3 * H.norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(P).eigenvalues()[0], -1e-12 * P.norm());
  }
}

/// Uniform strain is reproduced exactly, whatever the clusters.
TEST(AveragedElasticity, PassesThePatchTest) {
  const Block block = make_block({2, 1, 1}, {4, 3, 3}, 0.2);
  const auto term = make_elasticity(block.rest, block.tets, rubber(0.4999), Element::averaged_volume);
  Matrix3 G;
  G << 0.02, 0.01, 0.0, -0.01, -0.015, 0.02, 0.005, 0.0, -0.004;
  const auto at_boundary = [&](const Vector3& r) -> std::array<std::optional<double>, 3> {
    const bool boundary = r.x() == 0 || r.x() == 2 || r.y() == 0 || r.y() == 1 || r.z() == 0 || r.z() == 1;
    if (!boundary) return {};
    const Vector3 u = G * r;
    return {u.x(), u.y(), u.z()};
  };
  const Equilibrium result = equilibrium(block.rest, *term, at_boundary, 1e-11);
  ASSERT_TRUE(result.converged);
  const Positions expected = block.rest + block.rest * G.transpose();
  EXPECT_LT((result.x - expected).cwiseAbs().maxCoeff(), 1e-11);
}

/// Pure bending of a bar two cells high, held at ν = 0.4999: the stored energy over beam theory's E I κ² L/2, which is
/// exact here (the ends are prescribed along the bar only).
TEST(AveragedElasticity, BendsWhereTheLinearElementLocks) {
  const Block bar = make_block({4, 1, 1}, {8, 2, 2}, 0.2);
  const double kappa = 1e-3, exact = 0.5 / 12.0 * kappa * kappa * 4.0;
  const auto ratio = [&](Element element) {
    const auto term = make_elasticity(bar.rest, bar.tets, rubber(0.4999), element);
    const auto bend = [&](const Vector3& r) {
      std::array<std::optional<double>, 3> u;
      if (r.x() == 0.0) u[0] = 0.0;
      if (r.x() == 4.0) u[0] = -4.0 * kappa * (r.z() - 0.5);
      if (r.x() == 0.0 && r.y() == 0.0 && r.z() == 0.0) u[1] = u[2] = 0.0;
      if (r.x() == 0.0 && r.y() == 1.0 && r.z() == 0.0) u[2] = 0.0;
      return u;
    };
    const Equilibrium result = equilibrium(bar.rest, *term, bend, 1e-9);
    EXPECT_TRUE(result.converged);
    return result.energy / exact;
  };
  EXPECT_GT(ratio(Element::linear), 10.0);
  const double averaged = ratio(Element::averaged_volume);
  EXPECT_GT(averaged, 1.0);
  EXPECT_LT(averaged, 1.7);
}

}  // namespace averaged_elasticity_test
}  // namespace tacipc
