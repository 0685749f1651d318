// The integral equation of a bonded layer against its limits.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <optional>

#include "verification/bonded_layer.h"
#include "verification/closed_forms.h"

namespace tacipc::verify {
namespace bonded_layer_test {

using std::numbers::pi;
using Shape = LayerProblem::Shape;

const Elastic kGel{1.2e5, 0.43};

TEST(BondedLayer, QuadratureIsExactForPolynomials) {
  const Quadrature q = gauss_legendre(5, -1.0, 3.0);
  double sum = 0.0;
  for (int i = 0; i < 5; ++i) sum += q.weight[i] * std::pow(q.node[i], 9);
  EXPECT_NEAR(sum, (std::pow(3.0, 10) - 1.0) / 10.0, 1e-9 * sum);
}

/// Answer of a layer to the pressure J₀(ξ r) from the equations of elasticity alone. With u_r = U(z) J₁(ξr),
/// u_z = W(z) J₀(ξr), ξ = 1 and μ = 1, the equations are
///   U″ − m U − (m − 1) W′ = 0,   m W″ − W + (m − 1) U′ = 0,   m = (λ + 2μ)/μ = 2(1 − ν)/(1 − 2ν),
/// stresses on z = 0 (the top; the layer fills −ω < z < 0): σ_zz = m W′ + (m − 2) U, σ_rz = U′ − W.
/// Integrated by Runge–Kutta from the base up, for the two unknown slopes there.
double kernel_by_integration(double omega, double nu) {
  const double m = 2.0 * (1.0 - nu) / (1.0 - 2.0 * nu);
  using State = Eigen::Vector4d;  // U, U′, W, W′
  const auto slope = [&](const State& s) {
    return State(s[1], m * s[0] + (m - 1.0) * s[3], s[3], (s[2] - (m - 1.0) * s[1]) / m);
  };
  const auto top = [&](State s) {
    const int steps = 4000;
    const double d = omega / steps;
    for (int i = 0; i < steps; ++i) {
      const State a = slope(s), b = slope(s + d / 2 * a), c = slope(s + d / 2 * b), e = slope(s + d * c);
      s += d / 6 * (a + 2 * b + 2 * c + e);
    }
    return s;
  };
  const State first = top({0, 1, 0, 0}), second = top({0, 0, 0, 1});
  Eigen::Matrix2d stress;
  for (int i = 0; i < 2; ++i) {
    const State& s = i == 0 ? first : second;
    stress.col(i) << m * s[3] + (m - 2.0) * s[0], s[1] - s[2];
  }
  const Eigen::Vector2d share = stress.inverse() * Eigen::Vector2d(-1.0, 0.0);
  const double sinks = -(share[0] * first[2] + share[1] * second[2]);
  return sinks / (1.0 - nu);  // half space: (2/E*) with E* = 2 μ (1 + ν)/(1 − ν²) = 2/(1 − ν)
}

TEST(BondedLayer, KernelSolvesTheEquationsOfElasticity) {
  for (const double nu : {0.0, 0.3, 0.43, 0.49}) {
    for (const double omega : {0.1, 0.5, 1.0, 2.0, 4.0}) {
      EXPECT_NEAR(bonded_layer_kernel(omega, nu) / kernel_by_integration(omega, nu), 1.0, 1e-7)
          << "nu " << nu << ", omega " << omega;
    }
  }
}

TEST(BondedLayer, ThickLayerIsAHalfSpace) {
  for (const double nu : {0.3, 0.43, 0.5}) {
    const Elastic gel{1e5, nu};
    const LayerSolution thick = press_bonded_layer({gel, 1e3, Shape::paraboloid, 0.01}, 1e-4);
    EXPECT_NEAR(thick.force_n / hertz(gel, 0.01, 1e-4).force_n, 1.0, 1e-5);
    EXPECT_NEAR(thick.contact_radius_m / hertz(gel, 0.01, 1e-4).contact_radius_m, 1.0, 1e-5);
    const LayerSolution sphere = press_bonded_layer({gel, 1e3, Shape::sphere, 0.01}, 2e-3);
    EXPECT_NEAR(sphere.force_n / sneddon_sphere(gel, 0.01, 2e-3).force_n, 1.0, 2e-5);
    const LayerSolution punch = press_bonded_layer({gel, 1e3, Shape::flat, 0.01}, 1e-4);
    EXPECT_NEAR(punch.force_n / flat_punch_force_n(gel, 0.01, 1e-4), 1.0, 1e-4);
  }
}

TEST(BondedLayer, ThinCompressibleLayerIsABedOfSprings) {
  // F = π R δ² (λ + 2μ)/h, a = √(2Rδ); the rim adds a part that falls at least like h/a.
  const Elastic gel{1e5, 0.3};
  double before = 1.0;
  for (const double thickness : {0.02, 0.01, 0.005}) {
    const double R = 1.0, depth = 0.02, a = std::sqrt(2 * R * depth);
    const double springs = pi * R * depth * depth * (gel.lame_lambda_pa() + 2.0 * gel.shear_modulus_pa()) / thickness;
    const LayerSolution found = press_bonded_layer({gel, thickness, Shape::paraboloid, R}, depth, 96);
    const double excess = found.force_n / springs - 1.0;
    EXPECT_LT(std::abs(excess), 3.0 * thickness / a) << thickness;
    if (before < 1.0) {
      EXPECT_LT(std::abs(excess / before), 0.5);
    }
    before = excess;
  }
}

TEST(BondedLayer, AnElasticIndenterAddsItsCompliance) {
  const double R = 0.01, depth = 1e-4;
  const auto force = [&](double thickness_m, std::optional<Elastic> indenter) {
    return press_bonded_layer({kGel, thickness_m, Shape::paraboloid, R, indenter}, depth).force_n;
  };
  const auto hertz_with = [&](double plane_modulus_pa) { return hertz({plane_modulus_pa, 0.0}, R, depth).force_n; };
  const Elastic ball{6e4, 0.3};
  const double both = 1.0 / (1.0 / kGel.plane_modulus_pa() + 1.0 / ball.plane_modulus_pa());
  // A half space that is pressed into another one: Hertz with both moduli.
  EXPECT_NEAR(force(1e3, ball) / hertz_with(both), 1.0, 1e-5);
  // As good as rigid: a rigid one. Far softer than the gel: the layer is a rigid base, however thin.
  EXPECT_NEAR(force(2e-3, Elastic{6e12, 0.3}) / force(2e-3, std::nullopt), 1.0, 1e-6);
  EXPECT_NEAR(force(2e-3, Elastic{6.0, 0.3}) / hertz_with(6.0 / (1.0 - 0.09)), 1.0, 2e-4);
  // In between the layer is stiffer than a half space, but not by as much as under a rigid one.
  const double stiffer = force(2e-3, ball) / force(1e3, ball);
  EXPECT_GT(stiffer, 1.02);
  EXPECT_LT(stiffer, force(2e-3, std::nullopt) / force(1e3, std::nullopt));
}

TEST(BondedLayer, CollocationConverges) {
  const LayerProblem problem{kGel, 0.002, Shape::sphere, 0.004};
  const double finest = press_bonded_layer(problem, 2.5e-4, 96).force_n;
  EXPECT_NEAR(press_bonded_layer(problem, 2.5e-4, 12).force_n / finest, 1.0, 1e-6);
  EXPECT_NEAR(press_bonded_layer(problem, 2.5e-4, 48).force_n / finest, 1.0, 1e-9);
}

TEST(BondedLayer, ForceIsTheDerivativeOfNothingElse) {
  // For a linear solution dF/dδ at fixed contact radius is the flat punch's stiffness (the rim carries no pressure).
  const LayerProblem problem{kGel, 0.002, Shape::sphere, 0.004};
  const double depth = 2e-4, step = 1e-7;
  const double slope =
      (press_bonded_layer(problem, depth + step).force_n - press_bonded_layer(problem, depth - step).force_n) /
      (2 * step);
  const double radius = press_bonded_layer(problem, depth).contact_radius_m;
  const double punch = press_bonded_layer({kGel, 0.002, Shape::flat, radius}, 1.0).force_n;
  EXPECT_NEAR(slope / punch, 1.0, 1e-5);
}

TEST(BondedLayer, DimitriadisSeriesIsItsBeginning) {
  // The series agrees to the accuracy of its printed coefficients at small χ and drifts away at larger ones.
  for (const double nu : {0.3, 0.43, 0.5}) {
    const Elastic gel{1e5, nu};
    const auto ratio = [&](double chi) {
      const double R = 0.1, h = 0.002, depth = chi * chi * h * h / R;
      return dimitriadis_force_n(gel, h, R, depth) / press_bonded_layer({gel, h, Shape::paraboloid, R}, depth).force_n;
    };
    EXPECT_NEAR(ratio(0.05), 1.0, 0.01) << nu;
    EXPECT_GT(ratio(0.5), 0.90) << nu;
    EXPECT_LT(ratio(0.5), 0.97) << nu;
  }
}

}  // namespace bonded_layer_test
}  // namespace tacipc::verify
