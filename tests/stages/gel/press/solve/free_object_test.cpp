// An object that moves and turns freely: its system against differences, its flight and its contact against mechanics
// by hand.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/contact_assembly.h"
#include "stages/gel/press/solve/time_step.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace {

TriangleMesh moved(TriangleMesh mesh, const Vector3& by) {
  mesh.positions.rowwise() += by.transpose();
  return mesh;
}

/// Contact of one tetrahedron with a box that its control points carry, tilted and a little strained: all kinds of
/// pairs, each near.
class CarriedPairs : public ::testing::Test {
 protected:
  static constexpr double kDHat = 0.5;
  const Positions gel_{{0.1, 0.15, 0.0}, {1.0, 0.0, -0.1}, {0.0, 1.0, -0.2}, {0.2, 0.2, -1.0}};
  const TriangleMesh box_ = make_box({-0.4, -0.3, 0.25}, {0.9, 0.8, 1.2});
  const AffineBody body_ = make_affine_body(box_.positions, box_.triangles, 3.0);
  ContactMesh mesh_ = make_contact_mesh(gel_, Triangles{{0, 1, 2}}, box_.positions, box_.triangles);
  FreeVertices free_ = [&] {
    std::vector<bool> fixed(16, false);
    for (int v = 3; v < 12; ++v) fixed[v] = true;  // one of the gel's, and the box's own, which follow from its points
    FreeVertices free(16, fixed);
    free.carried = {{4, body_.weights, 12}};
    free.num_control_points = 4;
    return free;
  }();
  const std::shared_ptr<const EnergyTerm> elasticity_ =
      std::make_shared<Elasticity>(gel_, Tetrahedra{{0, 2, 1, 3}}, NeoHookean{2.0, 3.0});

  Positions start() const {
    Positions x(16, 3);
    x.topRows(4) = gel_;
    const Matrix3 tilt = Eigen::AngleAxisd(0.1, Vector3(1, 2, 0.5).normalized()).toRotationMatrix();
    x.bottomRows(4) = (body_.rest_m * tilt.transpose()).rowwise() + Eigen::RowVector3d(0.02, 0.01, -0.03);
    x(13, 1) += 0.01;
    free_.carried[0].carry(x);
    return x;
  }
  std::vector<ContactPair> pairs() const {
    std::vector<ContactPair> all;
    for (const auto& t : mesh_.object.triangles) {
      for (const int v : mesh_.gel.vertices) all.push_back(point_triangle_pair(v, t));
    }
    for (const int v : mesh_.object.vertices) all.push_back(point_triangle_pair(v, mesh_.gel.triangles[0]));
    for (const auto& e : mesh_.gel.edges) {
      for (const auto& f : mesh_.object.edges) all.push_back(edge_edge_pair(e, f));
    }
    return all;
  }
  /// x after the free vertices have gone by d.
  Positions after(const Positions& x, const Eigen::VectorXd& d) const {
    Positions y = x;
    for (int i = 0; i < free_.size(); ++i) y.row(free_.vertex_of_free[i]) += d.segment<3>(3 * i).transpose();
    free_.carried[0].carry(y);
    return y;
  }
};

TEST_F(CarriedPairs, GradientAndHessianAreDerivativesByTheControlPoints) {
  const ContactBarrier barrier(mesh_, pairs(), kDHat);
  const Friction friction(barrier, start(), start(), 0.05);
  for (const ContactTerm* term : std::initializer_list<const ContactTerm*>{&barrier, &friction}) {
    const auto at = [&](const Positions& y) {
      const std::vector<int> active = term->active(y);
      const auto pattern = cover_contacts(mesh_pattern(free_, *elasticity_), free_, 4, *term, active, y);
      NewtonSystem system;
      clear(system, free_, pattern);
      const Positions still = Positions::Zero(16, 3);
      assemble_contact(0.7, *term, active, y, free_, 4, Blend(std::vector<double>(4, 0.0)),
                       {still, false, Vector3::Zero()}, system);
      return system;
    };
    const Eigen::VectorXd away = Eigen::VectorXd::LinSpaced(3 * free_.size(), -0.01, 0.013).array().sin();
    const Positions x = after(start(), 0.3 * away);
    const NewtonSystem system = at(x);
    ASSERT_GT(system.gradient.tail<12>().norm(), 1e-3) << term->name();
    Eigen::VectorXd d(3 * free_.size());
    for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(1.0 + 2.3 * static_cast<double>(i));
    const double h = 1e-6;
    const double slope = 0.7 * (term->value(after(x, h * d)) - term->value(after(x, -h * d))) / (2 * h);
    EXPECT_NEAR(system.gradient.dot(d), slope, 1e-6 * system.gradient.norm()) << term->name();
    const Eigen::VectorXd difference = (at(after(x, h * d)).gradient - at(after(x, -h * d)).gradient) / (2 * h);
    EXPECT_LT((system.hessian.multiply(d) - difference).norm(), 1e-6 * difference.norm()) << term->name();
  }
}

TEST_F(CarriedPairs, ContactActsOnTheBodyAsOnTheGelTheOtherWay) {
  const ContactBarrier barrier(mesh_, pairs(), kDHat);
  const Positions x = start();
  NewtonSystem system;
  const std::vector<int> active = barrier.active(x);
  FreeVertices free = free_;
  clear(system, free, cover_contacts(mesh_pattern(free, *elasticity_), free, 4, barrier, active, x));
  const Positions still = Positions::Zero(16, 3);
  assemble_contact(1.0, barrier, active, x, free, 4, Blend(4), {still, false, Vector3::Zero()}, system);
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
  for (int i = 0; i < free.size(); ++i) {
    const Vector3 of_row = system.gradient.segment<3>(3 * i), at = x.row(free.vertex_of_free[i]);
    force += of_row;
    torque += at.cross(of_row);
  }
  // One vertex of the gel is held; it is below all others and nothing touches it.
  EXPECT_LT(force.norm(), 1e-12 * system.gradient.norm());
  EXPECT_LT(torque.norm(), 1e-12 * system.gradient.norm());
}

/// A free box above or on a plate: a gel whose whole surface is held.
class FreeBox : public ::testing::Test {
 protected:
  static constexpr double kH = 1e-3, kMu = 0.5, kSpeed = 1e-4, kDHat = 1e-5, kDensity = 6e4, kG = 9.81;

  FreeBox() : FreeBox({0.004, 0.005, 0.003}, 0.5 * kDHat) {}
  FreeBox(const Vector3& half, double height)
      : box_(moved(make_box({-half.x(), -half.y(), 0.0}, {half.x(), half.y(), 2.0 * half.z()}),
                   Vector3(0.35e-3, 0.2e-3, height))),
        body_(make_affine_body(box_.positions, box_.triangles, kDensity)) {
    mesh_ = make_contact_mesh(gel_.positions, gel_.boundary, box_.positions, box_.triangles);
    mesh_.num_control_points = 4;
    state_.x.resize(mesh_.num_rows(), 3);
    state_.x << mesh_.rest_positions, body_.rest_m;
    state_.velocity_m_s = Positions::Zero(gel_.num_vertices(), 3);
    settings_.pair_counting.once = true;
  }
  /// Steps under a gravity of its own.
  void go(int steps, const Vector3& gravity, double h = kH, const Vector3& load = Vector3::Zero()) {
    settings_.gravity_m_s2 = gravity;
    TimeStepper stepper(mesh_, plate(), settings_, body_);
    for (int i = 0; i < steps; ++i) {
      report_ = stepper.advance(state_, {.h_s = h, .object_target = {}, .load_n = load, .free_object = true},
                                [](int, double) {});
      largest_residual_n_ = std::max(largest_residual_n_, report_.body_residual_n);
    }
    forces_ = stepper.forces();
  }
  GelModel plate() const {
    std::vector<int> held;
    for (int v = 0; v < gel_.num_vertices(); ++v) {
      if (std::abs(gel_.positions(v, 2) + 0.001) > 1e-9) held.push_back(v);
    }
    return {.elasticity = make_elasticity(gel_.positions, gel_.tets, NeoHookean{4.3e4, 2.6e5}, Element::linear),
            .tets = gel_.tets,
            .mass_kg = Eigen::VectorXd::Constant(gel_.num_vertices(), 1e-4),
            .glued = held};
  }
  ControlPoints points() const { return state_.x.bottomRows<4>(); }
  Vector3 velocity() const { return state_.object_motion.velocity_m_s; }
  Vector3 spin() const { return angular_velocity(body_, points(), state_.object_motion); }
  double weight_n() const { return body_.mass_kg * kG; }

  TetMesh gel_ = block_gel(4, 0.04, 0.002);
  TriangleMesh box_;
  AffineBody body_;
  ContactMesh mesh_;
  State state_;
  StepSettings settings_{.d_hat_m = kDHat,
                         .barrier_stiffness_j_m4 = 7e13,
                         .friction = FrictionSettings{.coefficient = kMu,
                                                      .speed_threshold_m_s = kSpeed,
                                                      .max_lag_iterations = 50,
                                                      .relative_lag_tolerance = 1e-6},
                         .newton = {.velocity_tolerance_m_s = 1e-8, .force_tolerance_n = 1e-6}};
  StepReport report_;
  StepForces forces_;
  double largest_residual_n_ = 0.0;
};

class FlyingBox : public FreeBox {
 protected:
  FlyingBox() : FreeBox({0.004, 0.005, 0.003}, 0.03) {}
};

TEST_F(FlyingBox, FallsAsEulersMethodSays) {
  const double start = center_of(points()).z(), v0 = 0.2, h = 5e-3;
  state_.object_motion = make_rigid_motion(body_, points(), {0.1, 0, v0}, Vector3::Zero());
  go(10, {0, 0, -kG}, h);
  const double t = 10 * h;
  EXPECT_NEAR(center_of(points()).z() - start, v0 * t - 0.5 * kG * t * (t + h), 1e-10);
  EXPECT_NEAR(velocity().z(), v0 - kG * t, 1e-7);
  EXPECT_NEAR(velocity().x(), 0.1, 1e-7);
  EXPECT_LT(spin().norm(), 1e-6);
}

TEST_F(FlyingBox, KeepsItsSpinAndItsMomentumThatImplicitEulerWouldLose) {
  const Vector3 omega(0, 0, 20.0);
  state_.object_motion = make_rigid_motion(body_, points(), Vector3::Zero(), omega);
  const Vector3 momentum = state_.object_motion.angular_momentum_kg_m2_s;
  const Positions before = mesh_.object_rows(state_.x);
  go(20, Vector3::Zero(), 5e-3);  // two radians: 1/sqrt(1 + 2 h omega^2 t) = 0.45 without the predictor
  EXPECT_LT((state_.object_motion.angular_momentum_kg_m2_s - momentum).norm(), 1e-6 * momentum.norm());
  EXPECT_LT((spin() - omega).norm(), 1e-6 * omega.norm());
  const Vector3 c = center_of(points());
  const Matrix3 turn = Eigen::AngleAxisd(2.0, Vector3::UnitZ()).toRotationMatrix();
  const Positions expected = ((before.rowwise() - c.transpose()) * turn.transpose()).rowwise() + c.transpose();
  EXPECT_LT((mesh_.object_rows(state_.x) - expected).cwiseAbs().maxCoeff(), 1e-8);
}

TEST_F(FreeBox, RestsOnAPlateUnderItsWeight) {
  go(60, {0, 0, -kG});
  EXPECT_LT(velocity().norm(), 1e-7);
  EXPECT_LT(spin().norm(), 1e-5);
  EXPECT_NEAR(-forces_.normal.col(2).sum(), weight_n(), 1e-4 * weight_n());
  EXPECT_LT(largest_residual_n_, 1e-3 * weight_n());
  EXPECT_LT(strain_of(body_, points()), 1e-5);
  // A load at its centre adds to that.
  go(60, {0, 0, -kG}, kH, {0, 0, -0.4});
  EXPECT_NEAR(-forces_.normal.col(2).sum(), weight_n() + 0.4, 1e-4 * weight_n());
}

TEST_F(FreeBox, SticksBelowTheAngleOfFrictionAndSlidesAbove) {
  go(60, {0, 0, -kG});
  const auto gravity = [](double part) {
    const double angle = std::atan(part * kMu);
    return Vector3(kG * std::sin(angle), 0, -kG * std::cos(angle));
  };
  // tan θ = 0.9 μ: creep by ε_v (1 − √(1 − 0.9)), where the smoothed friction carries it.
  go(300, gravity(0.9));
  EXPECT_NEAR(velocity().x(), kSpeed * (1.0 - std::sqrt(0.1)), 0.01 * kSpeed);
  // tan θ = 1.2 μ: dv/dt = g (sin θ − μ cos θ) once it slides.
  const Vector3 g = gravity(1.2);
  go(10, g);
  ASSERT_GT(velocity().x(), kSpeed);
  const double before = velocity().x();
  go(20, g);
  const double gained = 20 * kH * (g.x() + kMu * g.z());
  EXPECT_NEAR(velocity().x() - before, gained, 2e-3 * gained);
  EXPECT_LT(std::abs(velocity().y()), 1e-3 * gained);
}

class TallBox : public FreeBox {
 protected:
  TallBox() : FreeBox({0.002, 0.005, 0.006}, 0.5 * kDHat) {}
};

/// A box three times as high as it is wide along x tips over its edge at tan θ = 1/3, long before it slides.
TEST_F(TallBox, TipsOverItsEdgeWhereItsWeightPointsPastIt) {
  go(60, {0, 0, -kG});
  const auto gravity = [](double tangent) {
    const double angle = std::atan(tangent);
    return Vector3(kG * std::sin(angle), 0, -kG * std::cos(angle));
  };
  go(100, gravity(0.97 / 3.0));
  EXPECT_LT(spin().norm(), 0.02);  // it stands, and still rocks by micrometres on the barrier
  const Vector3 steep = gravity(1.1 / 3.0);
  go(5, steep);
  const auto angle = [&] { return Eigen::AngleAxisd(rotation_of(body_, points())).angle(); };
  double turned = angle(), rate = spin().y();
  const double rate_before = rate;
  go(10, steep);
  // About the edge: I φ″ = m (g_x (H cos φ + w sin φ) − |g_z| (w cos φ − H sin φ)), turned by φ towards +x.
  const double w = 0.002, height = 0.006, inertia = body_.mass_kg * 4.0 / 3.0 * (w * w + height * height);
  constexpr int kParts = 10000;
  for (int i = 0; i < kParts; ++i) {
    const double c = std::cos(turned), sn = std::sin(turned);
    rate += 10 * kH / kParts * body_.mass_kg / inertia *
            (steep.x() * (height * c + w * sn) + steep.z() * (w * c - height * sn));
    turned += 10 * kH / kParts * rate;
  }
  EXPECT_NEAR(spin().y(), rate, 0.02 * rate);
  // Each step turns at the rate of its end.
  EXPECT_NEAR(angle(), turned + 0.5 * kH * (rate - rate_before), 0.01 * turned);
}

}  // namespace
}  // namespace tacipc
