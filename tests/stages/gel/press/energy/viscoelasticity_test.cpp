// Stress that relaxes, against the closed forms of a Prony series.
#include "stages/gel/press/energy/viscoelasticity.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <numbers>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/solve/assembly.h"
#include "tests/stages/gel/press/elastic_block.h"

namespace tacipc {
namespace viscoelasticity_test {

const std::vector<Relaxation> kSeries{{0.3, 0.5}, {0.2, 0.04}};
constexpr double kLasting = 0.5;  // g∞

struct Gel {
  Element element;
  ElasticLaw law;
};
const std::vector<Gel> kGels{{Element::linear, NeoHookean{2.0, 3.0}},
                             {Element::linear, StvkHencky{2.0, 3.0}},
                             {Element::averaged_volume, NeoHookean{2.0, 98.0}},
                             {Element::averaged_volume, StvkHencky{2.0, 98.0}}};

double youngs_modulus(const ElasticLaw& law) {
  return std::visit(
      [](const auto& l) { return l.mu_pa * (3.0 * l.lambda_pa + 2.0 * l.mu_pa) / (l.lambda_pa + l.mu_pa); }, law);
}

Positions crumpled(const Block& block, double amount, double phase) {
  Positions x = block.rest;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double t = static_cast<double>(v) + phase;
    x.row(v) += amount * Vector3(std::sin(3.0 * t), std::cos(5.0 * t), std::sin(2.0 + t)).transpose();
  }
  return x;
}

/// Σ V F S ∇Nᵢ at every vertex.
Positions force_of(const RestBody& body, const SymmetricRows& stress, const Positions& x) {
  Positions force = Positions::Zero(x.rows(), 3);
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t) {
    const RestTet& tet = body.rest[static_cast<std::size_t>(t)];
    TetCorners corners;
    for (int k = 0; k < 4; ++k) corners.col(k) = x.row(body.tets(t, k)).transpose();
    const Matrix3 F = corners * tet.shape_gradients.transpose();
    const TetCorners of_tet = tet.volume_m3 * F * symmetric(stress, t) * tet.shape_gradients;
    for (int k = 0; k < 4; ++k) force.row(body.tets(t, k)) += of_tet.col(k).transpose();
  }
  return force;
}

TEST(TetStress, CarriesTheElementsForcesAndKnowsNoRotation) {
  const Block block = make_block({1, 1, 1}, {2, 2, 2}, 0.2);
  const Positions x = crumpled(block, 0.03, 0.0);
  const Matrix3 turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Gel& gel : kGels) {
    const auto elasticity = make_elasticity(block.rest, block.tets, gel.law, gel.element);
    const TetStress stress = make_tet_stress(block.rest, block.tets, gel.law, gel.element);
    const Positions expected = gradient_of(*elasticity, x);
    EXPECT_LT((force_of(*stress.body(), stress(x), x) - expected).norm(), 1e-12 * expected.norm());
    EXPECT_LT((stress(x * turn.transpose()) - stress(x)).norm(), 1e-12 * stress(x).norm());
    EXPECT_LT(stress(block.rest).norm(), 1e-12);
  }
}

/// What a step minimises has at its end the forces of the stress that its history then holds, however large strains,
/// rotations and steps are.
TEST(Viscoelasticity, TheEnergyOfAStepHasTheForcesOfItsLastStress) {
  const Block block = make_block({1, 1, 1}, {2, 2, 2}, 0.2);
  const Matrix3 turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Gel& gel : kGels) {
    const auto elasticity = make_elasticity(block.rest, block.tets, gel.law, gel.element);
    const Viscoelasticity model({{kSeries, make_tet_stress(block.rest, block.tets, gel.law, gel.element)}});
    Viscoelasticity::History history;
    Positions x = block.rest;
    double phase = 0.0;
    for (const double h_s : {0.01, 0.3, 5.0}) {
      const SymmetricRows start = model.stress(x);
      const auto memory = model.memory(history, start, h_s);
      x = crumpled(block, 0.03, phase += 1.0) * turn;
      const Positions found =
          model.elastic_factors(h_s).front() * gradient_of(*elasticity, x) + gradient_of(*memory, x);
      model.advance(history, model.stress(x) - start, h_s);
      SymmetricRows whole = model.stress(x);
      for (const SymmetricRows& member : history) whole += member;
      const TetStress body = make_tet_stress(block.rest, block.tets, gel.law, gel.element);
      EXPECT_LT((found - force_of(*body.body(), whole, x)).norm(), 1e-12 * found.norm()) << h_s;
    }
  }
}

/// Of several bodies each relaxes by its own series and remembers what it would alone, bit for bit; one without a
/// series is elastic.
TEST(Viscoelasticity, OfSeveralBodiesEachIsAsItIsAlone) {
  const Block block = make_block({1, 1, 1}, {2, 2, 1}, 0.2);
  const auto n = block.rest.rows();
  const std::vector<Relaxation> slow{{0.1, 3.0}};
  const auto stress_of = [&](const Gel& gel, const Positions& rest, int body) {
    return make_tet_stress(rest, Tetrahedra(block.tets.array() + body * static_cast<int>(n)), gel.law, gel.element);
  };
  Positions rest(3 * n, 3);
  rest << block.rest, block.rest, block.rest;
  const Gel &first = kGels[0], &last = kGels[2];
  const Viscoelasticity together(
      {{kSeries, stress_of(first, rest, 0)}, {{}, std::nullopt}, {slow, stress_of(last, rest, 2)}});
  const Viscoelasticity of_first({{kSeries, stress_of(first, block.rest, 0)}}),
      of_last({{slow, stress_of(last, block.rest, 0)}});
  Viscoelasticity::History history, history_first, history_last;
  Positions x = rest;
  double phase = 0.0;
  for (const double h_s : {0.01, 0.3, 5.0}) {
    EXPECT_EQ(together.elastic_factors(h_s),
              (std::vector<double>{of_first.elastic_factors(h_s).front(), 1.0, of_last.elastic_factors(h_s).front()}));
    const Positions x_first = x.topRows(n), x_last = x.bottomRows(n);
    const SymmetricRows start = together.stress(x), start_first = of_first.stress(x_first),
                        start_last = of_last.stress(x_last);
    const auto memory = together.memory(history, start, h_s);
    const auto memory_first = of_first.memory(history_first, start_first, h_s),
               memory_last = of_last.memory(history_last, start_last, h_s);
    phase += 1.0;
    x << crumpled(block, 0.03, phase), crumpled(block, 0.02, phase), crumpled(block, 0.01, phase);
    const Positions force = gradient_of(*memory, x);
    EXPECT_EQ(force.topRows(n), gradient_of(*memory_first, x.topRows(n)));
    EXPECT_TRUE(force.middleRows(n, n).isZero(0.0));
    EXPECT_EQ(force.bottomRows(n), gradient_of(*memory_last, x.bottomRows(n)));
    together.advance(history, together.stress(x) - start, h_s);
    of_first.advance(history_first, of_first.stress(x.topRows(n)) - start_first, h_s);
    of_last.advance(history_last, of_last.stress(x.bottomRows(n)) - start_last, h_s);
    ASSERT_EQ(history.size(), 3u);
    EXPECT_EQ(history[0], history_first[0]);
    EXPECT_EQ(history[1], history_first[1]);
    EXPECT_EQ(history[2], history_last[0]);
  }
}

/// A term that is a sum of others, each with its weight.
class Sum final : public EnergyTerm {
 public:
  explicit Sum(std::vector<WeightedTerm> parts) : parts_(std::move(parts)) {}
  int num_stencils() const override {
    int count = 0;
    for (const WeightedTerm& part : parts_) count += part.term->num_stencils();
    return count;
  }
  std::span<const int> stencil(int i) const override {
    const WeightedTerm& part = owner(i);
    return part.term->stencil(i);
  }
  void evaluate(int i, const Eigen::VectorXd& x, Order order, Local& out) const override {
    const WeightedTerm& part = owner(i);
    part.term->evaluate(i, x, order, out);
    out.value *= part.weight;
    if (order >= Order::gradient) out.gradient *= part.weight;
    if (order >= Order::hessian) out.hessian *= part.weight;
  }

 private:
  const WeightedTerm& owner(int& i) const {
    for (const WeightedTerm& part : parts_) {
      if (i < part.term->num_stencils()) return part;
      i -= part.term->num_stencils();
    }
    return parts_.front();
  }
  std::vector<WeightedTerm> parts_;
};

/// A bar of unit cross-section and length that is stretched along x with free sides, in time steps.
class Bar {
 public:
  explicit Bar(const Gel& gel)
      : elasticity_(make_elasticity(block_.rest, block_.tets, gel.law, gel.element)),
        model_({{kSeries, make_tet_stress(block_.rest, block_.tets, gel.law, gel.element)}}) {}

  /// \return the force with which its end pulls after a step to this strain
  double pull(double strain, double h_s) {
    const SymmetricRows start = model_.stress(x_);
    const Sum energy({{model_.elastic_factors(h_s).front(), elasticity_}, {1.0, model_.memory(history_, start, h_s)}});
    const auto ends = [&](const Vector3& r) {
      std::array<std::optional<double>, 3> u;
      if (r.x() == 0.0) u[0] = 0.0;
      if (r.x() == 1.0) u[0] = strain;
      if (r.isZero()) u[1] = u[2] = 0.0;
      if (r == Vector3(0, 1, 0)) u[2] = 0.0;
      return u;
    };
    const Equilibrium found = equilibrium(block_.rest, energy, ends, 1e-12);
    EXPECT_TRUE(found.converged);
    x_ = found.x;
    model_.advance(history_, model_.stress(x_) - start, h_s);
    double force = 0.0;
    for (Eigen::Index v = 0; v < x_.rows(); ++v) force -= block_.rest(v, 0) == 1.0 ? found.force(v, 0) : 0.0;
    return force;
  }

  Positions x() const { return x_; }

 private:
  Block block_ = make_block({1, 1, 1}, {2, 2, 2}, 0.2);
  std::shared_ptr<const EnergyTerm> elasticity_;
  Viscoelasticity model_;
  Viscoelasticity::History history_;
  Positions x_ = block_.rest;
};

/// E∞ [ε + Σ rᵢ ε̇ τᵢ (1 − e^{−T/τᵢ}) e^{−(t−T)/τᵢ}] after a ramp of duration T, in steps of any length.
TEST(Viscoelasticity, ABarStretchedAtAConstantRateAndHeldRelaxesAsThePronySeriesSays) {
  constexpr double kStrain = 1e-6, kRamp = 0.1;
  for (const Gel& gel : kGels) {
    Bar bar(gel);
    const auto expected = [&](double t) {
      double stress = kStrain * std::min(t / kRamp, 1.0);
      for (const Relaxation& member : kSeries) {
        const double tau = member.time_s;
        stress += member.part / kLasting * kStrain / kRamp * tau * -std::expm1(-std::min(t, kRamp) / tau) *
                  std::exp(-std::max(0.0, t - kRamp) / tau);
      }
      return youngs_modulus(gel.law) * stress;
    };
    double t = 0.0;
    for (const double h_s : {0.001, 0.03, 0.069, 0.01, 0.01, 0.5, 0.2, 3.0}) {
      t += h_s;
      const double force = bar.pull(kStrain * std::min(t / kRamp, 1.0), h_s);
      EXPECT_NEAR(force, expected(t), 2e-5 * expected(t)) << t;
    }
    EXPECT_GT(expected(0.001) / (0.01 * kStrain * youngs_modulus(gel.law)), 1.9);  // nearly the instantaneous modulus
    EXPECT_LT(expected(t), 1.01 * kStrain * youngs_modulus(gel.law));              // nearly the long-term one
  }
}

/// E′ = E₀ [g∞ + Σ gᵢ ω²τᵢ²/(1 + ω²τᵢ²)], E″ = E₀ Σ gᵢ ωτᵢ/(1 + ω²τᵢ²).
TEST(Viscoelasticity, ABarShakenBySmallStrainsHasTheDynamicModuliOfThePronySeries) {
  using std::numbers::pi;
  constexpr double kStrain = 1e-6;
  constexpr int kSteps = 96;  // of a period
  for (const Gel& gel : {kGels[0], kGels[2]}) {
    for (const double omega : {1.5, 30.0}) {
      Bar bar(gel);
      const double h_s = 2.0 * pi / omega / kSteps;
      std::complex<double> response = 0.0;
      const int settle = omega > 10.0 ? 20 * kSteps : kSteps;  // 8 times the longest relaxation time, at least
      for (int k = 1; k <= settle + kSteps; ++k) {
        const double angle = 2.0 * pi * k / kSteps;
        const double force = bar.pull(kStrain * std::sin(angle), h_s);
        if (k > settle) response += 2.0 / kSteps * force * std::polar(1.0, -angle);
      }
      // sin ωt is the real part of −i e^{iωt}.
      const std::complex<double> modulus = response / (kStrain * std::complex<double>(0.0, -1.0));
      std::complex<double> expected = kLasting;
      for (const Relaxation& member : kSeries) {
        const std::complex<double> turn(0.0, omega * member.time_s);
        expected += member.part * turn / (1.0 + turn);
      }
      expected *= youngs_modulus(gel.law) / kLasting;
      EXPECT_NEAR(modulus.real(), expected.real(), 2e-3 * expected.real()) << omega;
      EXPECT_NEAR(modulus.imag(), expected.imag(), 2e-3 * expected.imag()) << omega;
      EXPECT_GT(expected.imag(), 0.05 * expected.real());  // it does dissipate
    }
  }
}

TEST(Viscoelasticity, ALargeStrainHeldLongEndsAsTheElasticGelDoes) {
  for (const Gel& gel : kGels) {
    Bar bar(gel);
    const double sudden = bar.pull(0.3, 1e-6);
    double held = 0.0;
    for (int k = 0; k < 8; ++k) held = bar.pull(0.3, 4.0);
    Bar slow(gel);
    const double elastic = slow.pull(0.3, 1e9);
    EXPECT_NEAR(held, elastic, 1e-9 * elastic);
    EXPECT_LT((bar.x() - slow.x()).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(sudden, elastic / kLasting, 1e-4 * sudden);
  }
}

}  // namespace viscoelasticity_test
}  // namespace tacipc
