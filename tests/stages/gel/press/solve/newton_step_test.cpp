// The Newton step, with the object driven or yielding, against dense algebra over the whole bordered system.
#include "stages/gel/press/solve/newton_step.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/energy/friction.h"
#include "stages/gel/press/energy/inertia.h"
#include "stages/gel/press/energy/viscous_memory.h"
#include "tests/stages/gel/press/dense_derivatives.h"
#include "tests/stages/gel/press/small_scene.h"
#include "tests/stages/gel/press/solve/block_matrices.h"

namespace tacipc {
namespace newton_step_test {

/// A block of gel, glued below, deformed, with the tip of a pyramid in contact and sliding; numbers about 1.
class NewtonStepTest : public ::testing::Test {
 protected:
  NewtonStepTest() {
    const int n = mesh_.num_gel_vertices;
    for (int v = 0; v < mesh_.num_vertices(); ++v) {
      const double t = v;
      const bool of_gel = v < n;
      if (of_gel && !fixed_[v])
        x_.row(v) += 0.02 * Vector3(std::sin(3 * t), std::cos(5 * t), std::sin(2 + t)).transpose();
    }
    start_.bottomRows(5).rowwise() -= Eigen::RowVector3d(0.03, 0.02, 0.0);
    // Turned a little, and down: no mere translation.
    for (int v = n; v < mesh_.num_vertices(); ++v) motion_.row(v) << 0.01 * x_(v, 1), -0.01 * x_(v, 0), -0.02;
    std::vector<ContactPair> pairs = ContactSearch(mesh_).pairs(x_, Positions::Zero(x_.rows(), 3), kDHat);
    barrier_ = std::make_shared<ContactBarrier>(mesh_, std::move(pairs), ContactLaws({.d_hat_m = kDHat}));
    const Eigen::VectorXd mass = Eigen::VectorXd::LinSpaced(n, 50.0, 80.0);
    StepTerms terms;
    terms.elasticity = elasticity_;
    terms.inertia = std::make_shared<Inertia>(mass, Positions(x_.topRows(n).array() + 0.01));
    terms.object_pull =
        std::make_shared<Inertia>(Eigen::VectorXd::Constant(1, 30.0), Positions(x_.row(n).array() - 0.1), n);
    terms.barrier = barrier_;
    terms.friction = std::make_shared<Friction>(*barrier_, x_, start_, 0.05);
    potential_ =
        make_incremental_potential(terms, {.h_s = 0.5, .barrier_stiffness_j_m4 = 20.0, .friction_coefficient = 0.6});
  }

  static constexpr double kDHat = 0.5;

  TetMesh gel_ = block_gel(3, 6.0, 3.0);
  TriangleMesh object_ = [] {
    TriangleMesh object = pyramid(3.0, 2.0);
    object.positions.rowwise() += Eigen::RowVector3d(0.3, 0.2, 0.2);
    return object;
  }();
  ContactMesh mesh_ = make_contact_mesh(gel_.positions, gel_.boundary, {object_});
  std::vector<bool> fixed_ = [this] {
    std::vector<bool> fixed(static_cast<std::size_t>(mesh_.num_vertices()), false);
    for (const int v : gel_.vertices(BoundaryTag::glued)) fixed[v] = true;
    for (int v = mesh_.num_gel_vertices; v < mesh_.num_vertices(); ++v) fixed[v] = true;
    return fixed;
  }();
  FreeVertices free_ = all_but(fixed_);
  std::shared_ptr<const Elasticity> elasticity_ =
      std::make_shared<Elasticity>(gel_.positions, gel_.tets, NeoHookean{2.0, 7.0});
  Positions x_ = mesh_.rest_positions, start_ = x_, motion_ = Positions::Zero(x_.rows(), 3);
  std::shared_ptr<const ContactBarrier> barrier_;
  IncrementalPotential potential_;

  NewtonDirection direction(const std::vector<int>& axes, LinearSolverKind kind, double share) {
    NewtonStepper stepper(free_, mesh_.num_gel_vertices, elasticity_, kind);
    stepper.set_tolerance(1e-12);
    Blend blend(std::vector<double>(static_cast<std::size_t>(mesh_.num_gel_vertices), share));
    return stepper.direction({.potential = potential_, .x = x_, .motion = motion_, .free_axes = axes}, blend);
  }

  void keeps_all_but_contacts(StepTerms terms);

  /// Everything that direction() says, by one dense solve.
  NewtonDirection dense_direction(const std::vector<int>& axes, Order contact_order) const {
    const Eigen::Index n = 3 * x_.rows(), k = static_cast<Eigen::Index>(axes.size());
    DenseDerivatives sum{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
    for (const WeightedTerm& part : potential_.terms)
      sum += part.weight * dense_derivatives(*part.term, x_, Order::hessian);
    const DenseDerivatives of_barrier =
        potential_.barrier.weight * dense_derivatives(*potential_.barrier.term, x_, contact_order);
    const DenseDerivatives of_friction =
        potential_.friction.weight * dense_derivatives(*potential_.friction.term, x_, contact_order);
    sum += of_barrier;
    sum += of_friction;
    // p = motion + T z: z moves the free vertices, and then the object as a whole along its free axes.
    Eigen::MatrixXd T = Eigen::MatrixXd::Zero(n, 3 * free_.size() + k);
    for (int i = 0; i < free_.size(); ++i) T.block<3, 3>(3 * free_.vertex_of_free[i], 3 * i).setIdentity();
    for (Eigen::Index a = 0; a < k; ++a) {
      for (int v = mesh_.num_gel_vertices; v < mesh_.num_vertices(); ++v)
        T(3 * v + axes[static_cast<std::size_t>(a)], 3 * free_.size() + a) = 1.0;
    }
    const Eigen::VectorXd motion = motion_.reshaped<Eigen::RowMajor>();
    const Eigen::VectorXd gradient = T.transpose() * sum.gradient;
    const Eigen::VectorXd z =
        (T.transpose() * sum.hessian * T).partialPivLu().solve(-gradient - T.transpose() * (sum.hessian * motion));
    NewtonDirection out;
    out.p = (motion + T * z).reshaped<Eigen::RowMajor>(x_.rows(), 3);
    for (Eigen::Index a = 0; a < k; ++a) out.object_shift[axes[static_cast<std::size_t>(a)]] = z[3 * free_.size() + a];
    out.slope = gradient.dot(z);
    Vector3 barrier_force = Vector3::Zero(), contact_force = Vector3::Zero();
    for (const int v : free_.vertex_of_free) {
      out.gradient_sum += sum.gradient.segment<3>(3 * v).norm();
      barrier_force += of_barrier.gradient.segment<3>(3 * v);
      contact_force += of_barrier.gradient.segment<3>(3 * v) + of_friction.gradient.segment<3>(3 * v);
    }
    out.gradient_sum += gradient.tail(k).cwiseAbs().sum();
    out.contact_sum = std::min(barrier_force.norm(), contact_force.norm());
    return out;
  }
};

const std::vector<std::vector<int>> kFreeAxes{{}, {2}, {0, 2}, {1, 0}, {0, 1, 2}};

TEST_F(NewtonStepTest, IsThatOfDenseAlgebraHoweverTheObjectYields) {
  ASSERT_GT(barrier_->active(x_).size(), 5u);
  for (const LinearSolverKind kind : {LinearSolverKind::direct, LinearSolverKind::conjugate_gradient}) {
    for (const double share : {0.0, 1.0}) {
      for (const std::vector<int>& axes : kFreeAxes) {
        const NewtonDirection found = direction(axes, kind, share);
        const NewtonDirection expected = dense_direction(axes, share == 0.0 ? Order::hessian : Order::psd);
        ASSERT_EQ(found.largest_share, share) << "raised: this is no test of the exact Hessian";
        EXPECT_LT((found.p - expected.p).norm(), 1e-9 * expected.p.norm()) << axes.size();
        EXPECT_LT((found.object_shift - expected.object_shift).norm(), 1e-9 * expected.p.norm()) << axes.size();
        EXPECT_NEAR(found.slope, expected.slope, 1e-9 * std::abs(expected.slope));
        EXPECT_NEAR(found.gradient_sum, expected.gradient_sum, 1e-12 * expected.gradient_sum);
        EXPECT_NEAR(found.contact_sum, expected.contact_sum, 1e-12 * expected.contact_sum);
        for (const int axis : axes) EXPECT_GT(std::abs(found.object_shift[axis]), 1e-3);  // it does yield
      }
    }
  }
}

TEST_F(NewtonStepTest, SharesRaisedWithinACallAreInTheStepThatComesOfIt) {
  const auto limited = [&](LinearSolverKind kind, double longest_m) {
    NewtonStepper stepper(free_, mesh_.num_gel_vertices, elasticity_, kind);
    stepper.set_tolerance(1e-12);
    Blend blend(std::vector<double>(static_cast<std::size_t>(mesh_.num_gel_vertices), 0.0));
    return stepper.direction({.potential = potential_, .x = x_, .motion = motion_, .longest_m = longest_m}, blend);
  };
  const NewtonDirection exact = limited(LinearSolverKind::direct, 1.0),
                        raised = limited(LinearSolverKind::direct, 1e-6);
  ASSERT_EQ(exact.largest_share, 0.0);
  ASSERT_GT(raised.largest_share, 0.0);
  ASSERT_GT((raised.p - exact.p).norm(), 1e-3 * exact.p.norm());
  const NewtonDirection found = limited(LinearSolverKind::conjugate_gradient, 1e-6);
  EXPECT_EQ(found.largest_share, raised.largest_share);
  EXPECT_LT((found.p - raised.p).norm(), 1e-9 * raised.p.norm());
}

/// Whichever place it was last asked about.
TEST_F(NewtonStepTest, ABarrierKnowsItsActivePairsAtEveryPlace) {
  Positions away = x_;
  away.bottomRows(5).rowwise() += Eigen::RowVector3d(0.0, 0.0, kDHat);
  const ContactBarrier anew(mesh_, barrier_->pairs(), ContactLaws({.d_hat_m = kDHat}));
  const std::vector<int> near = barrier_->active(x_);
  const double energy = barrier_->value(x_);
  EXPECT_LT(barrier_->active(away).size(), near.size());
  EXPECT_LT(barrier_->value(away), 0.5 * energy);
  EXPECT_EQ(barrier_->active(x_), near);
  EXPECT_EQ(barrier_->value(x_), anew.value(x_));
}

/// A stepper keeps its matrix from call to call, but for elements that have changed and for contacts.
void NewtonStepTest::keeps_all_but_contacts(StepTerms terms) {
  terms.elasticity = elasticity_;
  terms.inertia = std::make_shared<Inertia>(Eigen::VectorXd::Constant(mesh_.num_gel_vertices, 60.0),
                                            Positions(x_.topRows(mesh_.num_gel_vertices)));
  const auto at = [&](const Positions& x) {
    terms.barrier = std::make_shared<ContactBarrier>(
        mesh_, ContactSearch(mesh_).pairs(x, Positions::Zero(x.rows(), 3), kDHat), ContactLaws({.d_hat_m = kDHat}));
    terms.friction = std::make_shared<Friction>(*terms.barrier, x, start_, 0.05);
    return make_incremental_potential(terms, {.h_s = 0.5, .barrier_stiffness_j_m4 = 20.0, .friction_coefficient = 0.6});
  };
  const auto direction_of = [&](NewtonStepper& stepper, const Positions& x) {
    stepper.set_tolerance(1e-12);
    Blend blend(mesh_.num_gel_vertices);
    return stepper.direction({.potential = at(x), .x = x, .motion = motion_}, blend).p;
  };
  const auto anew = [&](const Positions& x) {
    NewtonStepper stepper(free_, mesh_.num_gel_vertices, elasticity_, LinearSolverKind::conjugate_gradient);
    return direction_of(stepper, x);
  };
  // The object elsewhere, the gel as it was; and the gel moved, too, by little and by much.
  Positions aside = x_;
  aside.bottomRows(5).rowwise() += Eigen::RowVector3d(-0.6, 0.4, 0.1);
  Positions near = aside, far = aside;
  for (const int v : free_.vertex_of_free) {
    near.row(v) += 1e-3 * Vector3(std::cos(v), std::sin(2 * v), std::cos(3 * v)).transpose();
    far.row(v) += 0.04 * Vector3(std::cos(v), std::sin(2 * v), std::cos(3 * v)).transpose();
  }
  ASSERT_GT((anew(aside) - anew(x_)).norm(), 0.1 * anew(x_).norm());

  NewtonStepper stepper(free_, mesh_.num_gel_vertices, elasticity_, LinearSolverKind::conjugate_gradient);
  const Positions first = direction_of(stepper, x_);
  EXPECT_EQ(first, anew(x_));
  EXPECT_EQ(direction_of(stepper, aside), anew(aside));
  const Positions kept = direction_of(stepper, near);
  EXPECT_LT((kept - anew(near)).norm(), 0.01 * anew(near).norm());
  EXPECT_NE(kept, anew(near));  // it did keep elements
  EXPECT_EQ(direction_of(stepper, x_), first);
  EXPECT_LT((direction_of(stepper, far) - anew(far)).norm(), 0.1 * anew(far).norm());
  EXPECT_LT((direction_of(stepper, x_) - first).norm(), 0.1 * first.norm());
  stepper.reset();
  EXPECT_EQ(direction_of(stepper, x_), first);
}

TEST_F(NewtonStepTest, WhatItKeepsOfTheLastCallIsNotTheContacts) { keeps_all_but_contacts({}); }

/// A memory has the same Hessian everywhere, and another gradient.
TEST_F(NewtonStepTest, WhatItKeepsOfTheLastCallIsNotTheContactsOfAGelThatRemembers) {
  const TetStress stress = make_tet_stress(gel_.positions, gel_.tets, NeoHookean{2.0, 7.0}, Element::linear);
  StepTerms terms;
  terms.viscous_memory = std::make_shared<ViscousMemory>(stress.body(), 0.3 * stress(x_));
  keeps_all_but_contacts(terms);
}

/// Of columns solved to a hundredth, or less, the object's Schur complement may be indefinite, or its solution ascend,
/// which Armijo's rule would take for a step.
TEST_F(NewtonStepTest, DescendsHoweverCoarselyItIsSolved) {
  motion_.setZero();
  for (int place = 0; place < 60; ++place) {
    const int n = mesh_.num_gel_vertices;
    StepTerms terms;
    terms.elasticity = elasticity_;
    terms.object_pull = std::make_shared<Inertia>(Eigen::VectorXd::Constant(1, 1.0),
                                                  Positions(x_.row(n).array() + 0.04 * (place - 30)), n);
    terms.barrier = barrier_;
    const IncrementalPotential potential =
        make_incremental_potential(terms, {.h_s = 0.5, .barrier_stiffness_j_m4 = 2000.0, .friction_coefficient = 0.0});
    for (const double tolerance : {0.9, 0.5, 0.1, 1e-2}) {
      for (const std::vector<int>& axes : kFreeAxes) {
        NewtonStepper stepper(free_, n, elasticity_, LinearSolverKind::conjugate_gradient);
        stepper.set_tolerance(tolerance);
        Blend blend(n);
        const NewtonDirection found =
            stepper.direction({.potential = potential, .x = x_, .motion = motion_, .free_axes = axes}, blend);
        EXPECT_LT(found.slope, 0.0) << tolerance << ", " << axes.size() << " axes, place " << place;
      }
    }
  }
}

/// Tips that all but touch the gel make it yield sideways below each of them: contact pushes it off their tops. A
/// solver meets one of these places at a time; they are found together all the same.
TEST(NewtonStep, PlacesThatYieldAreFoundTogether) {
  const TetMesh gel = block_gel(8, 6.0, 3.0);
  TriangleMesh tips;
  constexpr int kTips = 4;
  for (int k = 0; k < kTips; ++k) {
    const TriangleMesh one = pyramid(0.3, 0.6);
    const Eigen::Index vertices = tips.positions.rows(), triangles = tips.triangles.rows();
    tips.positions.conservativeResize(vertices + one.positions.rows(), 3);
    tips.positions.bottomRows(one.positions.rows()) =
        one.positions.rowwise() + Eigen::RowVector3d(k % 2 ? 1.6 : -1.4, k / 2 ? 1.5 : -1.3, 0.02 + 0.002 * k);
    tips.triangles.conservativeResize(triangles + one.triangles.rows(), 3);
    tips.triangles.bottomRows(one.triangles.rows()) = one.triangles.array() + static_cast<int>(vertices);
  }
  const ContactMesh mesh = make_contact_mesh(gel.positions, gel.boundary, {tips});
  std::vector<bool> fixed(static_cast<std::size_t>(mesh.num_vertices()), false);
  for (const int v : gel.vertices(BoundaryTag::glued)) fixed[v] = true;
  for (int v = mesh.num_gel_vertices; v < mesh.num_vertices(); ++v) fixed[v] = true;
  const FreeVertices free = all_but(fixed);
  StepTerms terms;
  terms.elasticity = std::make_shared<Elasticity>(gel.positions, gel.tets, NeoHookean{2.0, 7.0});
  const Positions x = mesh.rest_positions, still = Positions::Zero(x.rows(), 3);
  constexpr double kDHat = 0.1;
  terms.barrier = std::make_shared<ContactBarrier>(mesh, ContactSearch(mesh).pairs(x, still, kDHat),
                                                   ContactLaws({.d_hat_m = kDHat}));
  const IncrementalPotential potential =
      make_incremental_potential(terms, {.h_s = 1.0, .barrier_stiffness_j_m4 = 3e4, .friction_coefficient = 0.0});
  NewtonStepper stepper(free, mesh.num_gel_vertices, terms.elasticity, LinearSolverKind::conjugate_gradient);
  Blend blend(std::vector<double>(static_cast<std::size_t>(mesh.num_gel_vertices), 0.0));
  const NewtonDirection found = stepper.direction({.potential = potential, .x = x, .motion = still}, blend);
  EXPECT_GT(found.largest_share, 0.0) << "nothing yields";
  EXPECT_LT(found.slope, 0.0);
  EXPECT_LE(stepper.times().solves, 4);
}

}  // namespace newton_step_test
}  // namespace tacipc
