// Several bodies as one energy, against each alone.
#include "stages/gel/press/energy/joined_term.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/local_patch.h"
#include "stages/gel/press/solve/newton_step.h"
#include "tests/stages/gel/press/elastic_block.h"

namespace tacipc {
namespace joined_term_test {

/// Three blocks of the same tetrahedra, each of its own material, law and element, deformed each in its way.
class ThreeBodies : public ::testing::Test {
 protected:
  struct Material {
    ElasticLaw law;
    Element element;
  };

  ThreeBodies() : rest_(3 * n_, 3), x_(3 * n_, 3) {
    for (int b = 0; b < 3; ++b) {
      Positions at = block_.rest;
      at.col(0).array() += 2.0 * b;
      rest_.middleRows(b * n_, n_) = at;
    }
    x_ = rest_;
    for (Eigen::Index v = 0; v < x_.rows(); ++v) {
      const auto t = static_cast<double>(v);
      x_.row(v) += 0.03 * Vector3(std::sin(3.0 * t), std::cos(5.0 * t), std::sin(2.0 + t)).transpose();
    }
    for (int b = 0; b < 3; ++b) bodies_.push_back(body(b));
    joined_ = std::make_shared<JoinedTerm>(bodies_);
  }

  std::shared_ptr<const EnergyTerm> body(int b) const {
    const Material& material = materials_[static_cast<std::size_t>(b)];
    return make_elasticity(rest_, Tetrahedra(block_.tets.array() + static_cast<int>(b * n_)), material.law,
                           material.element);
  }

  const Block block_ = make_block({1, 1, 1}, {2, 2, 2}, 0.2);
  const Eigen::Index n_ = block_.rest.rows();
  std::vector<Material> materials_{{NeoHookean{2.0, 7.0}, Element::linear},
                                   {NeoHookean{0.5, 90.0}, Element::averaged_volume},
                                   {StvkHencky{4.0, 3.0}, Element::linear}};
  Positions rest_, x_;
  std::vector<std::shared_ptr<const EnergyTerm>> bodies_;
  std::shared_ptr<const EnergyTerm> joined_;
};

TEST_F(ThreeBodies, HaveTheEnergyAndTheForcesOfEachAloneBitForBit) {
  double sum = 0.0;
  for (const auto& one : bodies_) sum += one->value(x_);
  EXPECT_EQ(joined_->value(x_), sum);
  const Positions force = gradient_of(*joined_, x_);
  int stencil = 0;
  for (int b = 0; b < 3; ++b) {
    const auto& one = *bodies_[static_cast<std::size_t>(b)];
    EXPECT_EQ(force.middleRows(b * n_, n_), gradient_of(one, x_).middleRows(b * n_, n_));
    for (int i = 0; i < one.num_stencils(); ++i, ++stencil) {
      const auto of_one = one.stencil(i), of_all = joined_->stencil(stencil);
      ASSERT_TRUE(std::equal(of_one.begin(), of_one.end(), of_all.begin(), of_all.end()));
      Eigen::VectorXd local_x;
      gather(x_, of_one, local_x);
      for (const Order order : {Order::hessian, Order::psd}) {
        Local expected, found;
        one.evaluate(i, local_x, order, expected);
        joined_->evaluate(stencil, local_x, order, found);
        ASSERT_EQ(found.value, expected.value);
        ASSERT_EQ(found.hessian, expected.hessian);
      }
    }
  }
  EXPECT_EQ(joined_->num_stencils(), stencil);
}

TEST_F(ThreeBodies, AreInvertedWhereOneIs) {
  x_.row(block_.tets(7, 0) + n_) += Eigen::RowVector3d(3, 3, 3);
  EXPECT_EQ(joined_->value(x_), std::numeric_limits<double>::infinity());
}

TEST_F(ThreeBodies, PartsAreThoseOfAJoinedTermOrTheTermItself) {
  EXPECT_EQ(parts_of(joined_), bodies_);
  EXPECT_EQ(parts_of(bodies_[1]), std::vector{bodies_[1]});
  EXPECT_TRUE(parts_of(nullptr).empty());
}

/// A patch keeps all parts, also those that are nowhere in it: each has a weight of its own.
TEST_F(ThreeBodies, RestrictedToAPatchStayParts) {
  std::vector<bool> moves(static_cast<std::size_t>(x_.rows()), false);
  const Eigen::Index seed = n_ + 13;
  moves[static_cast<std::size_t>(seed)] = true;
  const auto patch = restricted(joined_, moves);
  const auto parts = parts_of(patch);
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0]->num_stencils(), 0);
  EXPECT_EQ(parts[2]->num_stencils(), 0);
  EXPECT_EQ(parts[0]->value(x_), 0.0);
  EXPECT_EQ(parts[2]->value(x_), 0.0);
  EXPECT_LT((gradient_of(*patch, x_) - gradient_of(*joined_, x_)).row(seed).norm(), 1e-12);
}

/// Each part is multiplied by its own factor, and the solver's routes (packs of eight, stencils one by one, a Hessian
/// that is partly kept from the iteration before) all lead to the Newton step of each body alone.
TEST_F(ThreeBodies, EachHasTheNewtonStepThatItHasAloneWithItsFactor) {
  const std::vector<double> factors{1.0, 1.7, 0.6};
  const auto num_rows = static_cast<std::size_t>(x_.rows());
  std::vector<int> order(num_rows);
  std::iota(order.begin(), order.end(), 0);
  StepTerms terms;
  terms.inertia = std::make_shared<Inertia>(Eigen::VectorXd::Constant(x_.rows(), 50.0), rest_);
  const auto energy_of = [&](const std::shared_ptr<const EnergyTerm>& elasticity, const std::vector<double>& each) {
    terms.elasticity = elasticity;
    return make_incremental_potential(terms, {.h_s = 1.0, .elastic_factors = each});
  };
  /// A body, or all, with the bottom held.
  struct Held {
    NewtonStepper stepper;
    IncrementalPotential energy;
  };
  const auto held = [&](int body, const std::shared_ptr<const EnergyTerm>& elasticity,
                        const std::vector<double>& each) {
    std::vector<bool> fixed(num_rows);
    for (Eigen::Index v = 0; v < x_.rows(); ++v)
      fixed[static_cast<std::size_t>(v)] = rest_(v, 2) == 0.0 || (body >= 0 && v / n_ != body);
    return std::unique_ptr<Held>(
        new Held{{FreeVertices(order, fixed), static_cast<int>(num_rows), elasticity, LinearSolverKind::direct},
                 energy_of(elasticity, each)});
  };
  for (const bool all_packed : {false, true}) {
    if (all_packed) {
      materials_[2].law = NeoHookean{4.0, 3.0};
      bodies_[2] = body(2);
      joined_ = std::make_shared<JoinedTerm>(bodies_);
    }
    const auto together = held(-1, joined_, factors);
    std::vector<std::unique_ptr<Held>> alone;
    for (int b = 0; b < 3; ++b) {
      const auto k = static_cast<std::size_t>(b);
      alone.push_back(held(b, bodies_[k], {factors[k]}));
    }
    Positions x = x_;
    const Positions still = Positions::Zero(x.rows(), 3);
    Blend blend(static_cast<int>(num_rows), true);
    for (int iteration = 0; iteration < 3; ++iteration) {
      const NewtonDirection found = together->stepper.direction({together->energy, x, still}, blend);
      for (int b = 0; b < 3; ++b) {
        Held& one = *alone[static_cast<std::size_t>(b)];
        if (!all_packed) one.stepper.reset();  // no Hessian is kept where one of the bodies has no packs
        const NewtonDirection expected = one.stepper.direction({one.energy, x, still}, blend);
        EXPECT_LT((found.p - expected.p).middleRows(b * n_, n_).norm(), 1e-11 * expected.p.norm())
            << b << " in iteration " << iteration;
      }
      x += 0.5 * found.p;
    }
  }
}

}  // namespace joined_term_test
}  // namespace tacipc
