#include "stages/gel/press/measure/conservation.h"

#include <gtest/gtest.h>

#include "tests/make_mesh.h"

namespace tacipc {
namespace conservation_test {

constexpr double kH = 0.01;
const Vector3 kGravity(0.0, 0.0, -9.81);
const Eigen::VectorXd kMass = Eigen::Vector3d(0.002, 0.003, 0.001);

/// Three gel vertices that backward Euler's method moves by given forces.
WholeInstant gels_after(const WholeInstant& before, const Positions& force_n) {
  WholeInstant after = before;
  for (Eigen::Index v = 0; v < 3; ++v)
    after.gel_velocity_m_s.row(v) += kH * (force_n.row(v) / kMass[v] + kGravity.transpose());
  after.gel_m += kH * after.gel_velocity_m_s;
  return after;
}

WholeInstant moving_gels() {
  return {Positions{{0.1, 0.0, 0.2}, {0.3, -0.1, 0.0}, {0.0, 0.2, 0.1}},
          Positions{{0.5, 0.1, 0.0}, {-0.2, 0.3, 0.4}, {0.0, -0.7, 0.2}},
          {}};
}

TEST(Conservation, MomentumChangesByWeightAndMounts) {
  const WholeInstant start = moving_gels();
  // Vertex 0 is on a mount; 1 and 2 push each other along the line between their ends, which cancels.
  const Positions mount{{0.3, -0.2, 0.1}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  WholeInstant before = start, after;
  WholeAccount account = open_account(kMass, start, kGravity, 0.0);
  const Vector3 at_start = account.momentum_kg_m_s, angular_at_start = account.angular_momentum_kg_m2_s;
  for (int i = 0; i < 10; ++i) {
    after = gels_after(before, mount);
    // The line between the ends depends on the force; its direction settles at once for one this small.
    for (int k = 0; k < 20; ++k) {
      Positions force = mount;
      const Eigen::RowVector3d along = (after.gel_m.row(2) - after.gel_m.row(1)).normalized();
      force.row(1) -= 1e-3 * along;
      force.row(2) += 1e-3 * along;
      after = gels_after(before, force);
    }
    add_step(account, kMass, before, after, kGravity, {.h_s = kH, .mount_n = mount, .mount_before_n = mount});
    before = after;
  }
  EXPECT_LT(account.momentum_residual_n, 1e-14);
  EXPECT_LT(account.angular_residual_n_m, 1e-13);
  const Vector3 expected = 10 * kH * (Vector3(0.3, -0.2, 0.1) + kMass.sum() * kGravity);
  EXPECT_LT((account.impulse_n_s - expected).norm(), 1e-15);
  EXPECT_LT((account.momentum_kg_m_s - at_start - expected).norm(), 1e-15);
  EXPECT_LT((account.angular_momentum_kg_m2_s - angular_at_start - account.angular_impulse_n_m_s -
             account.method_angular_n_m_s)
                .norm(),
            1e-15);
  EXPECT_GT(account.method_angular_n_m_s.norm(), 1e-6);
}

TEST(Conservation, WhatNoForceExplainsIsTheResidual) {
  const WholeInstant before = moving_gels();
  WholeAccount account = open_account(kMass, before, kGravity, 0.0);
  Positions force = Positions::Zero(3, 3);
  force.row(1) << 0.0, 2e-3, 0.0;
  const WholeInstant after = gels_after(before, force);
  const StepExchange none{.h_s = kH, .mount_n = Positions::Zero(3, 3), .mount_before_n = Positions::Zero(3, 3)};
  add_step(account, kMass, before, after, kGravity, none);
  EXPECT_NEAR(account.momentum_residual_n, 2e-3, 1e-13);
  const Vector3 arm = after.gel_m.row(1);
  EXPECT_NEAR(account.angular_residual_n_m, arm.cross(Vector3(0, 2e-3, 0)).norm(), 1e-13);
  // Said to come from elsewhere it is none.
  WholeAccount known = open_account(kMass, before, kGravity, 0.0);
  StepExchange exchange = none;
  exchange.others = {Vector3(0, 2e-3, 0), arm.cross(Vector3(0, 2e-3, 0))};
  add_step(known, kMass, before, after, kGravity, exchange);
  EXPECT_LT(known.momentum_residual_n, 1e-13);
  EXPECT_LT(known.angular_residual_n_m, 1e-13);
}

/// Backward Euler's fall lies below the parabola: ½ m (g h)² in each step.
TEST(Conservation, AFallLosesWhatTheMethodTakes) {
  WholeInstant before = moving_gels();
  before.gel_velocity_m_s.setZero();
  WholeAccount account = open_account(kMass, before, kGravity, 0.0);
  const Positions zero = Positions::Zero(3, 3);
  const double at_start = account.gravitational_j;
  for (int i = 0; i < 5; ++i) {
    const WholeInstant after = gels_after(before, zero);
    add_step(account, kMass, before, after, kGravity, {.h_s = kH, .mount_n = zero, .mount_before_n = zero});
    before = after;
  }
  const double gh = 9.81 * kH, mass = kMass.sum();
  EXPECT_NEAR(account.kinetic_j, 0.5 * mass * 25.0 * gh * gh, 1e-15);
  EXPECT_NEAR(account.gravitational_j - at_start, -mass * gh * gh * 15.0, 1e-15);
  EXPECT_NEAR(account.method_loss_j, 5.0 * 0.5 * mass * gh * gh, 1e-15);
  EXPECT_EQ(account.work_j, 0.0);
}

/// A spring that a mount stretches slowly takes up all of its work; one that it turns takes none.
TEST(Conservation, MountsDoWorkByTheMeanOfTheirForces) {
  const Eigen::VectorXd mass = Eigen::Vector2d::Zero();
  const double stiffness = 40.0, rest = 0.1;
  WholeInstant before{Positions{{0, 0, 0}, {rest, 0, 0}}, Positions::Zero(2, 3), {}};
  Positions force_before = Positions::Zero(2, 3);
  WholeAccount account = open_account(mass, before, kGravity, 0.0);
  const auto go_to = [&](const Vector3& end) {
    WholeInstant after = before;
    after.gel_m.row(1) = end;
    const double stretch = end.norm() - rest;
    Positions force(2, 3);
    force.row(1) = stiffness * stretch * end.normalized();
    force.row(0) = -force.row(1);
    add_step(account, mass, before, after, kGravity,
             {.h_s = kH,
              .mount_n = force,
              .mount_before_n = force_before,
              .elastic_j = 0.5 * stiffness * stretch * stretch});
    before = after;
    force_before = force;
  };
  for (int i = 1; i <= 4; ++i) go_to(Vector3(rest + 0.005 * i, 0, 0));
  EXPECT_NEAR(account.work_j, 0.5 * stiffness * 0.02 * 0.02, 1e-15);
  for (int i = 1; i <= 10; ++i) go_to(0.12 * Vector3(std::cos(0.2 * i), std::sin(0.2 * i), 0));
  EXPECT_NEAR(account.work_j, 0.5 * stiffness * 0.02 * 0.02, 1e-15);
  EXPECT_NEAR(account.method_loss_j, 0.0, 1e-15);
  EXPECT_LT(account.angular_residual_n_m, 1e-15);
}

TEST(Conservation, AFreeBodyCountsAndAHeldOneOnlyByItsHeight) {
  const TriangleMesh box = make_box({-0.01, -0.02, -0.03}, {0.01, 0.02, 0.03});
  const AffineBody body = make_affine_body(box.positions, box.triangles, 1000.0);
  const auto at = [&](const Vector3& center, const Vector3& velocity, bool held) {
    const ControlPoints control = rigid_points(body, center, Matrix3::Identity());
    return WholeInstant{Positions(0, 3),
                        Positions(0, 3),
                        {{&body, control, make_rigid_motion(body, control, velocity, Vector3(0, 0, 3)), held}}};
  };
  const Eigen::VectorXd none(0);
  const Vector3 center(0.1, 0.0, 0.5), velocity(0.0, 0.2, 0.0);
  const double m = body.mass_kg, spin = body.rest_inertia_kg_m2(2, 2) * 3.0;
  const WholeAccount free = open_account(none, at(center, velocity, false), kGravity, 0.0);
  EXPECT_NEAR(free.kinetic_j, 0.5 * m * 0.04 + 0.5 * 3.0 * spin, 1e-15);
  EXPECT_NEAR(free.gravitational_j, m * 9.81 * 0.5, 1e-12);
  EXPECT_LT((free.momentum_kg_m_s - m * velocity).norm(), 1e-15);
  EXPECT_LT((free.angular_momentum_kg_m2_s - Vector3(-m * 0.1, 0, m * 0.02 + spin)).norm(), 1e-15);
  WholeAccount held = open_account(none, at(center, velocity, true), kGravity, 0.0);
  EXPECT_EQ(held.kinetic_j, 0.0);
  EXPECT_EQ(held.momentum_kg_m_s, Vector3::Zero());
  EXPECT_EQ(held.angular_momentum_kg_m2_s, Vector3::Zero());
  EXPECT_EQ(held.gravitational_j, free.gravitational_j);
  // In flight.
  WholeAccount flight = free;
  const Vector3 after = velocity + kH * kGravity;
  add_step(flight, none, at(center, velocity, false), at(center + kH * after, after, false), kGravity,
           {.h_s = kH, .mount_n = Positions(0, 3), .mount_before_n = Positions(0, 3)});
  EXPECT_LT(flight.momentum_residual_n, 1e-12);
  EXPECT_LT(flight.angular_residual_n_m, 1e-12);
  EXPECT_NEAR(flight.method_loss_j, 0.5 * m * 9.81 * 9.81 * kH * kH, 1e-13);
}

}  // namespace conservation_test
}  // namespace tacipc
