// An object that moves and turns freely: its system against differences, its flight and its contact against mechanics
// by hand.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/energy/orthogonality.h"
#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/contact_assembly.h"
#include "stages/gel/press/solve/time_step.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/small_scene.h"
#include "tests/stages/gel/press/solve/block_matrices.h"

namespace tacipc {
namespace time_step_free_object_test {

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
  ContactMesh mesh_ = make_contact_mesh(gel_, Triangles{{0, 1, 2}}, {box_});
  FreeVertices free_ = [&] {
    std::vector<bool> fixed(16, false);
    for (int v = 3; v < 12; ++v) fixed[v] = true;  // one of the gel's, and the box's own, which follow from its points
    FreeVertices free = all_but(fixed);
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
  const ContactBarrier barrier(mesh_, pairs(), ContactLaws({.d_hat_m = kDHat}));
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
    ASSERT_GT(system.gradient.tail<12>().norm(), 1e-3) << typeid(*term).name();
    Eigen::VectorXd d(3 * free_.size());
    for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(1.0 + 2.3 * static_cast<double>(i));
    const double h = 1e-6;
    const double slope = 0.7 * (term->value(after(x, h * d)) - term->value(after(x, -h * d))) / (2 * h);
    EXPECT_NEAR(system.gradient.dot(d), slope, 1e-6 * system.gradient.norm()) << typeid(*term).name();
    const Eigen::VectorXd difference = (at(after(x, h * d)).gradient - at(after(x, -h * d)).gradient) / (2 * h);
    EXPECT_LT((system.hessian.multiply(d) - difference).norm(), 1e-6 * difference.norm()) << typeid(*term).name();
  }
}

TEST_F(CarriedPairs, ContactActsOnTheBodyAsOnTheGelTheOtherWay) {
  const ContactBarrier barrier(mesh_, pairs(), ContactLaws({.d_hat_m = kDHat}));
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

constexpr double kH = 1e-3, kMu = 0.5, kSpeed = 1e-4, kDHat = 1e-5, kDensity = 6e4, kG = 9.81;

/// Gravity beside a plane whose slope is `tangent`, downhill along x.
Vector3 gravity_on(double tangent) {
  const double angle = std::atan(tangent);
  return {kG * std::sin(angle), 0.0, -kG * std::cos(angle)};
}

/// A free object above or on a plate: a gel whose whole surface is held.
class FreeBody : public ::testing::Test {
 protected:
  explicit FreeBody(TriangleMesh object, int cells = 4)
      : gel_(block_gel(cells, 0.04, 0.002)),
        object_(std::move(object)),
        body_(make_affine_body(object_.positions, object_.triangles, kDensity)) {
    mesh_ = make_contact_mesh(gel_.positions, gel_.boundary, {object_});
    mesh_.num_control_points = 4;
    state_.x.resize(mesh_.num_rows(), 3);
    state_.x << mesh_.rest_positions, body_.rest_m;
    state_.velocity_m_s = Positions::Zero(gel_.num_vertices(), 3);
    settings_.pair_counting.once = true;
  }
  /// Steps under a gravity of its own.
  void go(
      int steps, const Vector3& gravity, double h = kH, const Vector3& load = Vector3::Zero(),
      const std::function<void()>& after_step = [] {}) {
    settings_.gravity_m_s2 = gravity;
    TimeStepper stepper(mesh_, soft_ ? soft_gel() : plate(), settings_, std::vector{body_});
    for (int i = 0; i < steps; ++i) {
      report_ = stepper.advance(state_, {.h_s = h, .object_target = {}, .load_n = load, .free_object = true},
                                [](int, double) {});
      largest_residual_n_ = std::max(largest_residual_n_, report_.body_residual_n);
      forces_ = stepper.forces();
      after_step();
    }
  }
  GelModel soft_gel() const {
    std::vector<int> held;
    for (int v = 0; v < gel_.num_vertices(); ++v) {
      if (gel_.positions(v, 2) < -0.002 + 1e-9) held.push_back(v);
    }
    GelModel gel = plate();
    gel.glued = held;
    return gel;
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
  Vector3 velocity() const { return state_.object_motion[0].velocity_m_s; }
  Vector3 spin() const { return angular_velocity(body_, points(), state_.object_motion[0]); }
  double weight_n() const { return body_.mass_kg * kG; }

  TetMesh gel_;
  TriangleMesh object_;
  AffineBody body_;
  ContactMesh mesh_;
  State state_;
  StepSettings settings_{
      .laws = ContactLaws({.friction = kMu, .d_hat_m = kDHat}),
      .barrier_stiffness_j_m4 = 7e13,
      .friction =
          FrictionSettings{.speed_threshold_m_s = kSpeed, .max_lag_iterations = 50, .relative_lag_tolerance = 1e-6},
      .newton = {.velocity_tolerance_m_s = 1e-8, .force_tolerance_n = 1e-6}};
  StepReport report_;
  StepForces forces_;
  double largest_residual_n_ = 0.0;
  bool soft_ = false;  // the gel yields, held at its back alone
};

class FreeBox : public FreeBody {
 protected:
  explicit FreeBox(const Vector3& half = {0.004, 0.005, 0.003}, double height = 0.5 * kDHat)
      : FreeBody(moved(make_box({-half.x(), -half.y(), 0.0}, {half.x(), half.y(), 2.0 * half.z()}),
                       Vector3(0.35e-3, 0.2e-3, height))) {}
};

class FlyingBox : public FreeBox {
 protected:
  FlyingBox() : FreeBox({0.004, 0.005, 0.003}, 0.03) {}
};

TEST_F(FlyingBox, FallsAsEulersMethodSays) {
  const double start = center_of(points()).z(), v0 = 0.2, h = 5e-3;
  state_.object_motion[0] = make_rigid_motion(body_, points(), {0.1, 0, v0}, Vector3::Zero());
  go(10, {0, 0, -kG}, h);
  const double t = 10 * h;
  EXPECT_NEAR(center_of(points()).z() - start, v0 * t - 0.5 * kG * t * (t + h), 1e-10);
  EXPECT_NEAR(velocity().z(), v0 - kG * t, 1e-7);
  EXPECT_NEAR(velocity().x(), 0.1, 1e-7);
  EXPECT_LT(spin().norm(), 1e-6);
}

TEST_F(FlyingBox, KeepsItsSpinAndItsMomentumThatImplicitEulerWouldLose) {
  const Vector3 omega(0, 0, 20.0);
  state_.object_motion[0] = make_rigid_motion(body_, points(), Vector3::Zero(), omega);
  const Vector3 momentum = state_.object_motion[0].angular_momentum_kg_m2_s;
  const Positions before = mesh_.object_rows(state_.x);
  go(20, Vector3::Zero(), 5e-3);  // two radians: 1/sqrt(1 + 2 h omega^2 t) = 0.45 without the predictor
  EXPECT_LT((state_.object_motion[0].angular_momentum_kg_m2_s - momentum).norm(), 1e-6 * momentum.norm());
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
  // tan θ = 0.9 μ: creep by ε_v (1 − √(1 − 0.9)), where the smoothed friction carries it.
  go(300, gravity_on(0.9 * kMu));
  EXPECT_NEAR(velocity().x(), kSpeed * (1.0 - std::sqrt(0.1)), 0.01 * kSpeed);
  // tan θ = 1.2 μ: dv/dt = g (sin θ − μ cos θ) once it slides.
  const Vector3 g = gravity_on(1.2 * kMu);
  go(10, g);
  ASSERT_GT(velocity().x(), kSpeed);
  const double before = velocity().x();
  go(20, g);
  const double gained = 20 * kH * (g.x() + kMu * g.z());
  EXPECT_NEAR(velocity().x() - before, gained, 2e-3 * gained);
  EXPECT_LT(std::abs(velocity().y()), 1e-3 * gained);
}

TEST_F(FreeBox, StopsAfterTheDistanceThatFrictionAllows) {
  go(60, {0, 0, -kG});
  // Whole steps, so that the last of them ends at rest: Σ v_n h = v0²/(2 μ g) − v0 h/2.
  const double v0 = 40 * kMu * kG * kH, start = center_of(points()).x();
  state_.object_motion[0] = make_rigid_motion(body_, points(), {v0, 0, 0}, Vector3::Zero());
  go(45, {0, 0, -kG});
  ASSERT_LT(velocity().norm(), kSpeed);
  const double expected = v0 * v0 / (2.0 * kMu * kG) - 0.5 * v0 * kH;
  EXPECT_NEAR(center_of(points()).x() - start, expected, 2e-3 * expected);
}

class TallBox : public FreeBox {
 protected:
  TallBox() : FreeBox({0.002, 0.005, 0.006}, 0.5 * kDHat) {}
};

/// A box three times as high as it is wide along x tips over its edge at tan θ = 1/3, long before it slides.
TEST_F(TallBox, TipsOverItsEdgeWhereItsWeightPointsPastIt) {
  go(60, {0, 0, -kG});
  go(100, gravity_on(0.97 / 3.0));
  EXPECT_LT(spin().norm(), 0.02);  // it stands, and still rocks by micrometres on the barrier
  const Vector3 steep = gravity_on(1.1 / 3.0);
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

/// Within a percent of where it tips it stands, and falls.
TEST_F(TallBox, StandsJustBelowTheSlopeWhereItTips) {
  go(60, {0, 0, -kG});
  const auto angle = [&] { return Eigen::AngleAxisd(rotation_of(body_, points())).angle(); };
  for (const double part : {0.5, 0.7, 0.8, 0.9, 0.94, 0.96, 0.97, 0.98, 0.985, 0.99})  // more at once would rock it
    go(20, gravity_on(part / 3.0));
  go(50, gravity_on(0.99 / 3.0));
  EXPECT_LT(angle(), kDHat / 0.004);  // on both edges' barriers
  go(150, gravity_on(1.01 / 3.0));
  EXPECT_GT(angle(), 0.02);
}

/// The same with less friction than its slope needs to tip it: it slides, upright.
TEST_F(TallBox, SlidesBeforeItTipsWhereFrictionIsLow) {
  constexpr double kLow = 0.25;
  settings_.laws = ContactLaws({.friction = kLow, .d_hat_m = kDHat});
  go(60, {0, 0, -kG});
  const Vector3 g = gravity_on(0.3);
  go(20, g);
  ASSERT_GT(velocity().x(), kSpeed);
  const double before = velocity().x();
  go(20, g);
  const double gained = 20 * kH * (g.x() + kLow * g.z());
  EXPECT_NEAR(velocity().x() - before, gained, 0.01 * gained);
  EXPECT_LT(Eigen::AngleAxisd(rotation_of(body_, points())).angle(), 1e-3);
}

/// Let go on one edge it falls onto the other. An impact that neither bounces nor slips leaves it the angular momentum
/// about the edge that it meets: ω₊ = (1 − 1.5 sin² α) ω₋, tan α = width / height. [Housner 1963]
TEST_F(TallBox, LosesInRockingWhatAPlasticImpactTakes) {
  constexpr double kTilt = 0.03, kStep = 2e-4, w = 0.002, height = 0.006;
  settings_.newton.force_tolerance_n = 1e-5;
  const Matrix3 turn = Eigen::AngleAxisd(kTilt, Vector3::UnitY()).toRotationMatrix();
  const Vector3 edge = center_of(body_.rest_m) + Vector3(w, 0, -height);
  state_.x.bottomRows<4>() = rigid_points(body_, edge + turn * Vector3(-w, 0, height), turn);
  mesh_.object_rows(state_.x) = body_.weights * points();
  struct Moment {
    double time_s, angle, rate;
  };
  std::vector<Moment> moments;
  go(130, {0, 0, -kG}, kStep, Vector3::Zero(), [&] {
    const Matrix3 R = rotation_of(body_, points());
    moments.push_back({kStep * static_cast<double>(moments.size() + 1), std::atan2(R(0, 2), R(2, 2)), -spin().y()});
  });
  // Near enough to upright, both edges are in the barrier's reach.
  const double both = 1.5 * kDHat / (2.0 * w);
  const auto last = std::find_if(moments.begin(), moments.end(), [&](const Moment& m) { return m.angle < both; }) - 1;
  const auto first = std::find_if(moments.begin(), moments.end(), [&](const Moment& m) { return m.angle < -both; });
  const auto after = std::find_if(moments.begin(), moments.end(), [&](const Moment& m) { return m.angle < 0.0; });
  ASSERT_TRUE(first != moments.end());
  // Weight turns it on, and back afterwards, at the same rate.
  const double rate_of_rate = kG * w / (4.0 / 3.0 * (w * w + height * height));
  const double upright_s = after->time_s + after->angle / after->rate;
  const double rate_before = last->rate + rate_of_rate * (upright_s - last->time_s);
  const double rate_after = first->rate + rate_of_rate * (first->time_s - upright_s);
  const double sine2 = w * w / (w * w + height * height), expected = 1.0 - 1.5 * sine2;
  EXPECT_NEAR(rate_after / rate_before, expected, 0.03 * expected);
}

/// A ball about the y axis with `around` vertices on each of its circles about that.
TriangleMesh make_ball(double radius_m, int around, int bands) {
  std::vector<Vector3> vertices;
  for (int b = 1; b < bands; ++b) {
    const double latitude = std::numbers::pi * (1.0 * b / bands - 0.5);
    for (int k = 0; k < around; ++k) {
      const double longitude = 2.0 * std::numbers::pi * k / around;
      vertices.emplace_back(radius_m * Vector3(std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                                               std::cos(latitude) * std::sin(longitude)));
    }
  }
  const int south = static_cast<int>(vertices.size()), north = south + 1;
  vertices.emplace_back(0, -radius_m, 0);
  vertices.emplace_back(0, radius_m, 0);
  std::vector<std::array<int, 3>> faces;
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around, top = (bands - 2) * around;
    faces.push_back({south, k, next});
    faces.push_back({north, top + next, top + k});
    for (int b = 0; b + 2 < bands; ++b) {
      const int low = b * around, high = low + around;
      faces.push_back({low + k, high + k, high + next});
      faces.push_back({low + k, high + next, low + next});
    }
  }
  return make_mesh(vertices, faces);
}

constexpr double kRadius = 0.005;

class RollingBall : public FreeBody {
 protected:
  RollingBall() : FreeBody(moved(make_ball(kRadius, 256, 12), {-0.012, 0.2e-3, kRadius + 0.5 * kDHat})) {}
};

/// Facets of R/40 make a slope lumpy, but not by much.
TEST_F(RollingBall, RollsDownASlopeByFiveSevenths) {
  go(20, {0, 0, -kG});
  const Vector3 g = gravity_on(0.3);
  go(15, g);
  const double before = velocity().x();
  ASSERT_GT(before, 10 * kSpeed);
  go(30, g);
  const double gained = 30 * kH * 5.0 / 7.0 * g.x();
  EXPECT_NEAR(velocity().x() - before, gained, 0.03 * gained);
  EXPECT_NEAR(spin().y() * kRadius, velocity().x(), 0.01 * velocity().x());
}

class DroppedBall : public FreeBody {
 protected:
  DroppedBall() : FreeBody(moved(make_ball(kRadius, 32, 12), {0.4e-3, 0.2e-3, kRadius + 2.0 * kDHat}), 8) {
    soft_ = true;
  }
  /// Of gel, ball and contact, J.
  double energy() const {
    const Eigen::Index n = gel_.num_vertices();
    const GelModel gel = soft_gel();
    ContactSearch search(mesh_);
    const Positions still = Positions::Zero(state_.x.rows(), 3);
    const ContactBarrier barrier(
        mesh_, weighted(search.pairs(state_.x, still, kDHat), mesh_, settings_.laws, settings_.pair_counting),
        settings_.laws);
    const Eigen::VectorXd squares = state_.velocity_m_s.rowwise().squaredNorm();
    return 0.5 * gel.mass_kg.dot(squares) - gel.mass_kg.dot(state_.x.topRows(n) * settings_.gravity_m_s2) +
           gel.elasticity->value(state_.x) + kinetic_energy(body_, points(), state_.object_motion[0]) -
           body_.mass_kg * settings_.gravity_m_s2.dot(center_of(points())) +
           Orthogonality(mesh_.num_vertices(), body_).value(state_.x) +
           settings_.barrier_stiffness_j_m4 * barrier.value(state_.x);
  }
};

/// It meets the gel aslant and spinning. What contact gives to the gel it takes from the ball, and energy is only lost.
TEST_F(DroppedBall, KeepsTheBalanceOfMomentumAndNeverGainsEnergy) {
  const double h = 5e-4, v0 = 0.1;
  settings_.newton = {.velocity_tolerance_m_s = 1e-6, .force_tolerance_n = 1e-6};
  state_.object_motion[0] = make_rigid_motion(body_, points(), {0.05, 0, -v0}, {0, 0, 20.0});
  const Vector3 g(0, 0, -kG);
  settings_.gravity_m_s2 = g;
  double last = energy(), largest_n = 0.0;
  const double first = last;
  RigidMotion before = state_.object_motion[0];
  go(60, g, h, Vector3::Zero(), [&] {
    const Positions contact = forces_.normal + forces_.friction;
    const Vector3 center = center_of(points()), force = -contact.colwise().sum().transpose();
    Vector3 torque = Vector3::Zero();
    double friction_n = 0.0;
    for (Eigen::Index v = 0; v < contact.rows(); ++v) {
      torque -= (state_.x.row(v).transpose() - center).cross(Vector3(contact.row(v)));
      friction_n += forces_.friction.row(v).norm();
    }
    largest_n = std::max(largest_n, force.norm());
    const RigidMotion& now = state_.object_motion[0];
    const Vector3 gained = (now.velocity_m_s - before.velocity_m_s) / h - g;
    EXPECT_LT((body_.mass_kg * gained - force).norm(), 1e-3 * weight_n());
    // Friction acts on both sides of a gap: a couple.
    const Vector3 turned = (now.angular_momentum_kg_m2_s - before.angular_momentum_kg_m2_s) / h;
    EXPECT_LT((turned - torque).norm(), 1e-5 * weight_n() + kDHat * friction_n);
    before = now;
    const double energy_now = energy();
    EXPECT_LT(energy_now - last, 1e-6 * first);
    last = energy_now;
  });
  EXPECT_GT(largest_n, 3.0 * weight_n());
  EXPECT_GT(velocity().z(), -0.5 * v0);
  EXPECT_LT(last, 0.9 * first);
}

/// A pyramid that stands on its base, which is `cells` × `cells` squares of two triangles; the outermost rise to
/// `rim_height` at the rim.
TriangleMesh make_tessellated_pyramid(double half_x, double half_y, double height, double rim_height, int cells) {
  std::vector<Vector3> vertices;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const bool rim = i == 0 || j == 0 || i == cells || j == cells;
      vertices.emplace_back(half_x * (2.0 * i / cells - 1.0), half_y * (2.0 * j / cells - 1.0), rim ? rim_height : 0.0);
    }
  }
  const int tip = static_cast<int>(vertices.size()), n = cells;
  vertices.emplace_back(0, 0, height);
  const auto at = [&](int i, int j) { return j * (cells + 1) + i; };
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      faces.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
  for (int k = 0; k < n; ++k) {
    faces.push_back({at(k, 0), at(k + 1, 0), tip});
    faces.push_back({at(n, k), at(n, k + 1), tip});
    faces.push_back({at(k + 1, n), at(k, n), tip});
    faces.push_back({at(0, k + 1), at(0, k), tip});
  }
  return make_mesh(vertices, faces);
}

/// A flat face of triangles of 0.4 mm, turned against those of 2.5 mm of the plate, without friction. Its rim is out of
/// reach: a vertex of the plate at a sharp edge is pushed aside, and rightly so.
class FlatFace : public FreeBody {
 protected:
  FlatFace() : FreeBody(turned_pyramid(), 16) {
    settings_.friction.reset();
    settings_.barrier_stiffness_j_m4 = 7e11;  // many vertices carry it
  }
  static TriangleMesh turned_pyramid() {
    TriangleMesh pyramid = make_tessellated_pyramid(0.004, 0.005, 0.012, 5.0 * kDHat, 20);
    pyramid.positions *= Eigen::AngleAxisd(0.3, Vector3::UnitZ()).toRotationMatrix().transpose();
    return moved(pyramid, {-0.005, 0.2e-3, 0.5 * kDHat});
  }
  /// The largest of |tangential| over normal force at a hundred places of the plate.
  double largest_ratio() {
    go(40, {0, 0, -kG});
    state_.object_motion[0] = make_rigid_motion(body_, points(), {0.1, 0.03, 0}, Vector3::Zero());
    double largest = 0.0;
    go(100, {0, 0, -kG}, kH, Vector3::Zero(), [&] {
      const Vector3 force = forces_.normal.colwise().sum();
      largest = std::max(largest, force.head<2>().norm() / std::abs(force.z()));
    });
    return largest;
  }
};

/// Without friction a flat face feels nothing of the triangles under it, if every piece of surface pushes once.
TEST_F(FlatFace, SlidesOverTrianglesWithoutAnySidewaysForce) {
  EXPECT_LT(largest_ratio(), 1e-3);
  EXPECT_LT((velocity() - Vector3(0.1, 0.03, 0)).norm(), 1e-4);
}

TEST_F(FlatFace, CatchesOnTrianglesWhereEachPairPushesByItself) {
  settings_.pair_counting.once = false;
  EXPECT_GT(largest_ratio(), 2e-3);
}

}  // namespace time_step_free_object_test
}  // namespace tacipc
