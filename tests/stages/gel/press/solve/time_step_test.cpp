// Time steps against mechanics by hand: a block that sticks and slips on a plate, and a gel that swings.
#include "stages/gel/press/solve/time_step.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "stages/gel/press/energy/element.h"
#include "tests/stages/gel/press/dense_derivatives.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace time_step_test {

Positions moved(Positions positions, const Vector3& by) {
  positions.rowwise() += by.transpose();
  return positions;
}

/// A body of known mass that stands with one vertex on a plate and is pushed on: down by N, sideways by T. Its mass,
/// N, T, μ and ε_v give its motion in closed form.
class BlockOnAPlate : public ::testing::Test {
 protected:
  static constexpr double kH = 1e-3, kMass = 0.1, kNormal = 0.3, kMu = 0.4, kSpeed = 1e-4, kDHat = 1e-5;

  /// Takes `steps` steps under the sideways load.
  void push(const Vector3& sideways_n, int steps) {
    for (int i = 0; i < steps; ++i) {
      stepper_.advance(state_,
                       {.h_s = kH,
                        .object_target = state_.x.bottomRows(mesh_.num_object_vertices),
                        .free_axes = {0, 1, 2},
                        .load_n = sideways_n - Vector3(0, 0, kNormal),
                        .object_mass_kg = kMass},
                       [](int, double) {});
    }
  }
  Vector3 velocity() const { return state_.object_velocity_m_s; }
  /// On the plate.
  Vector3 friction() const { return stepper_.forces().friction.colwise().sum(); }
  Vector3 normal() const { return stepper_.forces().normal.colwise().sum(); }
  int count(ContactState wanted) const {
    const auto& states = stepper_.forces().contact_state;
    return static_cast<int>(std::count(states.begin(), states.end(), wanted));
  }

  TetMesh gel_ = block_gel(2, 0.02, 0.002);
  // Its tip over the inside of a triangle, all else of it beyond the barrier's reach of the triangle's edges.
  TriangleMesh object_ = pyramid(0.003, 0.002);
  ContactMesh mesh_ =
      make_contact_mesh(gel_.positions, gel_.boundary,
                        {{moved(object_.positions, Vector3(4e-3, 1.5e-3, 0.5 * kDHat)), object_.triangles}});
  TimeStepper stepper_{
      mesh_,
      // The whole surface is held: a rigid plate. Only vertices inside move, and nothing moves them.
      {.elasticity = make_elasticity(gel_.positions, gel_.tets, NeoHookean{4.3e4, 2.6e5}, Element::linear),
       .tets = gel_.tets,
       .mass_kg = Eigen::VectorXd::Constant(gel_.num_vertices(), 1e-4),
       .glued = held()},
      {.laws = ContactLaws({.friction = kMu, .d_hat_m = kDHat}),
       .barrier_stiffness_j_m4 = 7e13,
       .friction =
           FrictionSettings{.speed_threshold_m_s = kSpeed, .max_lag_iterations = 50, .relative_lag_tolerance = 1e-6},
       .newton = {.velocity_tolerance_m_s = 1e-11, .force_tolerance_n = 1e-9}}};
  State state_{.x = mesh_.rest_positions, .velocity_m_s = Positions::Zero(gel_.num_vertices(), 3)};

 private:
  std::vector<int> held() const {
    std::vector<int> held;
    for (int v = 0; v < gel_.num_vertices(); ++v) {
      if (std::abs(gel_.positions(v, 2) + 0.001) > 1e-9) held.push_back(v);
    }
    return held;
  }
};

const Vector3 kDirection(0.6, 0.8, 0.0);

TEST_F(BlockOnAPlate, SticksBelowMuNAndCreepsAsTheSmoothedLawSays) {
  push(Vector3::Zero(), 60);
  EXPECT_LT(velocity().norm(), 1e-9);
  EXPECT_NEAR(normal().z(), -kNormal, 1e-6 * kNormal);
  for (const double part : {0.36, 0.75, 0.99}) {
    // μ N f₁(v) = T with f₁ = 2 v/ε_v − (v/ε_v)².
    const double creep = kSpeed * (1.0 - std::sqrt(1.0 - part));
    push(part * kMu * kNormal * kDirection, 200);
    EXPECT_LT((velocity() - creep * kDirection).norm(), 1e-4 * creep) << part;
    // All of the load is carried, and by the plate.
    EXPECT_LT((friction() - part * kMu * kNormal * kDirection).norm(), 1e-5 * kMu * kNormal) << part;
    EXPECT_NEAR(normal().z(), -kNormal, 1e-6 * kNormal);
    EXPECT_EQ(count(ContactState::stick), 3);
    EXPECT_EQ(count(ContactState::slip), 0);
  }
  // A little more, and it slips as soon as it is faster than the threshold.
  push(1.02 * kMu * kNormal * kDirection, 2);
  ASSERT_GT(velocity().norm(), kSpeed);
  ASSERT_LT(velocity().norm(), 1.5 * kSpeed);
  EXPECT_EQ(count(ContactState::slip), 3);
  // Back to rest without the load.
  push(Vector3::Zero(), 200);
  EXPECT_LT(velocity().norm(), 1e-9);
  EXPECT_LT(friction().norm(), 1e-6 * kMu * kNormal);
}

TEST_F(BlockOnAPlate, SlipsAboveMuNHeldByMuNAgainstItsMotion) {
  push(Vector3::Zero(), 60);
  const double friction_n = kMu * kNormal;
  push(2.0 * friction_n * kDirection, 2);
  for (const double part : {2.0, 1.25, 1.01}) {
    const Vector3 before = velocity();
    push(part * friction_n * kDirection, 5);
    // m dv/dt = T − μ N.
    const double gained = 5 * kH * (part - 1.0) * friction_n / kMass;
    EXPECT_LT((velocity() - before - gained * kDirection).norm(), 1e-5 * gained) << part;
    EXPECT_LT((friction() - friction_n * kDirection).norm(), 1e-6 * friction_n) << part;
    EXPECT_EQ(count(ContactState::slip), 3);
    EXPECT_EQ(count(ContactState::stick), 0);
  }
  // Friction is against the motion, whatever the load: pushed across, it goes on slowing down along its way.
  const Vector3 across = kDirection.cross(Vector3::UnitZ());
  push(0.5 * friction_n * across, 1);
  EXPECT_LT((friction() - friction_n * velocity().normalized()).norm(), 1e-6 * friction_n);
  // And without a load it stops after the time that friction takes for its momentum.
  const double speed = velocity().norm();
  const int steps = static_cast<int>(kMass * speed / friction_n / kH);
  ASSERT_GT(steps, 5);
  push(Vector3::Zero(), steps - 1);
  EXPECT_NEAR(velocity().norm(), speed - (steps - 1) * kH * friction_n / kMass, 1e-5 * speed);
  EXPECT_EQ(count(ContactState::slip), 3);
  push(Vector3::Zero(), 60);
  EXPECT_LT(velocity().norm(), 1e-9);
  EXPECT_EQ(count(ContactState::stick), 3);
}

/// A gel that is shaken a little moves as implicit Euler with mass, stiffness and Rayleigh's damping says in dense
/// algebra: (M (1 + α h) + (β h + h²) K) u⁺ = M (u + h v + α h u) + β h K u.
TEST(TimeStepper, AFreeGelSwingsAsDenseAlgebraSaysWithDampingOfEitherKind) {
  const TetMesh gel = block_gel(2, 0.006, 0.002);
  const TriangleMesh object = pyramid(0.003, 0.002);
  const ContactMesh mesh = make_contact_mesh(gel.positions, gel.boundary,
                                             {{moved(object.positions, Vector3(0, 0, 0.01)), object.triangles}});
  const auto elasticity = make_elasticity(gel.positions, gel.tets, NeoHookean{4.3e4, 2.6e5}, Element::linear);
  const Eigen::VectorXd mass_kg =
      lumped_masses(gel.tets, make_rest_tets(gel.positions, gel.tets), gel.num_vertices(), 1010.0);
  const std::vector<int> glued = gel.vertices(BoundaryTag::glued);
  const Eigen::Index n = gel.num_vertices();
  constexpr double kStep = 5e-5;

  Positions shaken = Positions::Zero(n, 3);
  for (Eigen::Index v = 0; v < n; ++v) shaken.row(v) << 1e-3 * (1.0 + gel.positions(v, 2) / 0.002), 0.0, 2e-4;
  for (const int v : glued) shaken.row(v).setZero();
  // Without the rows and columns of glued vertices.
  Eigen::MatrixXd K = dense_derivatives(*elasticity, gel.positions, Order::hessian).hessian;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index v = 0; v < n; ++v) M.block<3, 3>(3 * v, 3 * v) = mass_kg[v] * Matrix3::Identity();
  for (const int v : glued) {
    K.middleRows<3>(3 * v).setZero();
    K.middleCols<3>(3 * v).setZero();
  }

  for (const auto& [alpha, beta] : {std::pair{0.0, 0.0}, {2e3, 0.0}, {0.0, 2e-4}, {1e3, 1e-4}}) {
    TimeStepper stepper(mesh, {.elasticity = elasticity, .tets = gel.tets, .mass_kg = mass_kg, .glued = glued},
                        {.laws = ContactLaws({.d_hat_m = 1e-5}),
                         .barrier_stiffness_j_m4 = 1e10,
                         .mass_damping_per_s = alpha,
                         .stiffness_damping_s = beta,
                         .newton = {.velocity_tolerance_m_s = 1e-8, .force_tolerance_n = 1e-8}});
    State state{.x = mesh.rest_positions, .velocity_m_s = shaken};
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * n), v = shaken.reshaped<Eigen::RowMajor>();
    const Eigen::PartialPivLU<Eigen::MatrixXd> system((1.0 + alpha * kStep) * M + (beta * kStep + kStep * kStep) * K);
    for (int step = 0; step < 20; ++step) {
      stepper.advance(state, {.h_s = kStep, .object_target = mesh.rest_positions.bottomRows(mesh.num_object_vertices)},
                      [](int, double) {});
      const Eigen::VectorXd next = system.solve(M * (u + kStep * v + alpha * kStep * u) + beta * kStep * (K * u));
      v = (next - u) / kStep;
      u = next;
      const Eigen::VectorXd found = state.velocity_m_s.reshaped<Eigen::RowMajor>();
      ASSERT_LT((found - v).norm(), 1e-3 * v.norm() + 1e-5 * shaken.norm())
          << "step " << step << ", damping " << alpha << " " << beta;
    }
  }
}

}  // namespace time_step_test
}  // namespace tacipc
