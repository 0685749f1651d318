// Several rigid objects, free, held and fixed: what they do to each other against mechanics by hand.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/solve/time_step.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace time_step_bodies_test {

constexpr double kH = 2e-3, kG = 9.81, kDensity = 2700.0, kSpeed = 1e-4, kDHat = 2e-5, kMu = 0.5;

/// Bodies far above a gel that takes no part.
class Bodies : public ::testing::Test {
 protected:
  /// Adds an object; those that may be free come first.
  void add(const TriangleMesh& object, bool free) {
    objects_.push_back(object);
    if (free) bodies_.push_back(make_affine_body(object.positions, object.triangles, kDensity));
  }
  void build() {
    mesh_ = make_contact_mesh(gel_.positions, gel_.boundary, objects_);
    mesh_.num_control_points = 4 * static_cast<int>(bodies_.size());
    state_.x.resize(mesh_.num_rows(), 3);
    state_.x.topRows(mesh_.num_vertices()) = mesh_.rest_positions;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      state_.x.middleRows<4>(mesh_.control_row(static_cast<int>(b))) = bodies_[b].rest_m;
    state_.velocity_m_s = Positions::Zero(gel_.num_vertices(), 3);
    state_.object_motion.assign(bodies_.size(), {});
  }
  /// Gives pairs of bodies laws of their own, numbered as objects.
  void override_laws(std::vector<LawOverride> overrides) {
    for (LawOverride& own : overrides) {
      for (int& body : own.between) ++body;
    }
    settings_.laws = ContactLaws::resolved(settings_.laws.all()[0], mesh_.num_bodies(), overrides);
  }
  GelModel gel() const {
    return {.elasticity = make_elasticity(gel_.positions, gel_.tets, NeoHookean{4.3e4, 2.6e5}, Element::linear),
            .tets = gel_.tets,
            .mass_kg = Eigen::VectorXd::Constant(gel_.num_vertices(), 1e-4),
            .glued = gel_.vertices(BoundaryTag::glued)};
  }
  void go(int steps, const Vector3& gravity, const std::vector<int>& held = {}) {
    settings_.gravity_m_s2 = gravity;
    TimeStepper stepper(mesh_, gel(), settings_, bodies_);
    StepGoal goal{.h_s = h_s_,
                  .object_target = mesh_.object_rows(state_.x),
                  .free_object = true,
                  .held_bodies = held,
                  .body_load_n = load_n_.empty() ? std::vector<Vector3>(bodies_.size(), Vector3::Zero()) : load_n_,
                  .control_target = mesh_.control_rows(state_.x)};
    for (int i = 0; i < steps; ++i) {
      const StepReport report = stepper.advance(state_, goal, [](int, double) {});
      worst_balance_ = std::max(worst_balance_, report.body_residual_n / report.body_load_n);
      iterations_ += report.newton_iterations;
      forces_ = stepper.forces();
    }
  }
  ControlPoints points(int body) const { return state_.x.middleRows<4>(mesh_.control_row(body)); }
  double weight_n(int body) const { return bodies_[static_cast<std::size_t>(body)].mass_kg * kG; }
  const Vector3& velocity(int body) const { return state_.object_motion[static_cast<std::size_t>(body)].velocity_m_s; }
  /// On object a by object b.
  const Wrench& on(int a, int b) const {
    return forces_.between[static_cast<std::size_t>((1 + a) * mesh_.num_bodies() + 1 + b)];
  }

  const TetMesh gel_ = block_gel(2, 0.01, 0.002);
  std::vector<TriangleMesh> objects_;
  std::vector<AffineBody> bodies_;
  ContactMesh mesh_;
  State state_;
  StepSettings settings_{
      .laws = ContactLaws({.friction = kMu, .d_hat_m = kDHat}),
      .front_edge_m = 1e-3,
      .barrier_stiffness_j_m4 = 2e12,
      .adaptive_barrier = true,
      .pair_counting = {.once = true},
      .friction =
          FrictionSettings{.speed_threshold_m_s = kSpeed, .max_lag_iterations = 50, .relative_lag_tolerance = 1e-3},
      .linear_solver = LinearSolverKind::conjugate_gradient,
      .newton = {.velocity_tolerance_m_s = 1e-7, .force_tolerance_n = 1e-6}};
  std::vector<Vector3> load_n_;  // on each; none where there are none
  StepForces forces_;
  double h_s_ = kH;
  double worst_balance_ = 0.0;
  int iterations_ = 0;
};

constexpr double kSide = 8e-3, kTable = 0.05;  // of a box; height of the table

TriangleMesh box_at(double x, double z) {
  return make_box({x - 0.5 * kSide, -0.5 * kSide, z}, {x + 0.5 * kSide, 0.5 * kSide, z + kSide});
}
TriangleMesh table() { return make_box({-0.03, -0.03, kTable - 0.005}, {0.03, 0.03, kTable}); }

TEST_F(Bodies, AStackCarriesItselfLevelByLevel) {
  constexpr double kGap = 0.5 * kDHat;
  for (int i = 0; i < 3; ++i) add(box_at(1e-3 * i, kTable + kGap + i * (kSide + kGap)), true);
  add(table(), false);
  build();
  go(100, {0, 0, -kG});
  EXPECT_LT(worst_balance_, 1e-3);
  // Each pushes down with all that lies on it, and is pushed up as much.
  for (int level = 0; level < 3; ++level) {
    const int below = level == 0 ? 3 : level - 1;
    double carried = 0.0;
    for (int i = level; i < 3; ++i) carried += weight_n(i);
    EXPECT_NEAR(on(level, below).force_n.z(), carried, 1e-3 * carried) << level;
    EXPECT_LT((on(level, below).force_n + on(below, level).force_n).norm(), 1e-12 * carried);
    EXPECT_LT(velocity(level).norm(), 1e-5);
    EXPECT_NEAR(center_of(points(level)).z(), kTable + (level + 0.5) * kSide, 2.0 * kDHat * (level + 1));
    EXPECT_NEAR(center_of(points(level)).x(), 1e-3 * level, 1e-5);
  }
  EXPECT_EQ(on(0, 2).force_n.norm(), 0.0);  // they do not touch
}

TEST_F(Bodies, TwoThatCollideKeepTheirMomentum) {
  add(box_at(-0.006, kTable), true);
  add(box_at(0.006, kTable), true);
  build();
  settings_.friction.reset();
  const double m = bodies_[0].mass_kg;
  state_.object_motion[0] = make_rigid_motion(bodies_[0], points(0), {0.2, 0.01, 0}, Vector3::Zero());
  const auto momentum = [&]() -> Vector3 { return m * (velocity(0) + velocity(1)); };
  const Vector3 before = momentum();
  go(15, Vector3::Zero());
  EXPECT_GT(velocity(1).x(), 0.05);
  EXPECT_LT((momentum() - before).norm(), 1e-4 * before.norm());
  // Nothing went through anything: the first is still on its side.
  EXPECT_LT(center_of(points(0)).x() + kSide, center_of(points(1)).x() + 1e-5);
}

TEST_F(Bodies, FrictionIsThatOfEachPair) {
  // On a slope of tan θ = 0.5, one box with μ 0.7 and one with 0.25; all others have 0.5.
  constexpr double kAbove = kTable + 0.5 * kDHat;
  add(box_at(-0.015, kAbove), true);
  add(box_at(0.010, kAbove), true);
  add(table(), false);
  build();
  override_laws({{.between = {0, 2}, .friction = 0.7}, {.between = {1, 2}, .friction = 0.25}});
  go(20, {0, 0, -kG});
  const double angle = std::atan(0.5);
  const Vector3 slope(kG * std::sin(angle), 0, -kG * std::cos(angle));
  go(10, slope);
  const double v0 = velocity(1).x();
  go(10, slope);
  EXPECT_NEAR((velocity(1).x() - v0) / (10 * kH), kG * (std::sin(angle) - 0.25 * std::cos(angle)), 0.02);
  EXPECT_LT(velocity(0).x(), kSpeed);
  EXPECT_GT(velocity(0).x(), 0.0);
}

TEST_F(Bodies, APairMayTouchFromNearer) {
  constexpr double kPart = 0.1;
  add(box_at(0.0, kTable + 0.6 * kPart * kDHat), true);
  add(table(), false);
  build();
  override_laws({{.between = {0, 1}, .d_hat_m = kPart * kDHat}});
  go(60, {0, 0, -kG});
  EXPECT_NEAR(on(0, 1).force_n.z(), weight_n(0), 1e-3 * weight_n(0));
  const double gap = state_.x.middleRows(mesh_.objects[0].first_vertex, 8).col(2).minCoeff() - kTable;
  EXPECT_GT(gap, 0.0);
  EXPECT_LT(gap, kPart * kDHat);
}

TEST_F(Bodies, OneThatIsHeldCarriesAnotherAndStaysExactlyWhereItIs) {
  add(box_at(0.0, kTable), true);
  add(box_at(0.001, kTable + kSide + 0.5 * kDHat), true);
  build();
  const Positions before = mesh_.objects[0].rows(state_.x);
  go(40, {0, 0, -kG}, {0});
  EXPECT_EQ((mesh_.objects[0].rows(state_.x) - before).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_NEAR(on(1, 0).force_n.z(), weight_n(1), 1e-3 * weight_n(1));
  EXPECT_LT(velocity(1).norm(), 1e-5);
}

TEST_F(Bodies, ADirectSolverFindsTheSame) {
  add(box_at(0.0, kTable + 0.5 * kDHat), true);
  add(box_at(0.001, kTable + kSide + kDHat), true);
  add(table(), false);
  build();
  const State start = state_;
  go(30, {0, 0, -kG});
  const Positions iterative = state_.x;
  state_ = start;
  settings_.linear_solver = LinearSolverKind::direct;
  go(30, {0, 0, -kG});
  EXPECT_LT((state_.x - iterative).cwiseAbs().maxCoeff(), 1e-8);
}

/// Around a circle, so many corners; the first on x.
constexpr int kCorners = 128;
Vector3 on_circle(double radius, int corner, double z) {
  const double angle = 2.0 * std::numbers::pi * corner / kCorners;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// A surface between closed curves of kCorners points each, the last joined to the first one again or each end closed
/// by a fan around a point.
TriangleMesh turned(const std::vector<std::pair<double, double>>& radius_and_z, bool ring) {
  TriangleMesh mesh;
  const int curves = static_cast<int>(radius_and_z.size());
  mesh.positions.resize(curves * kCorners + (ring ? 0 : 2), 3);
  std::vector<std::array<int, 3>> triangles;
  for (int c = 0; c < curves; ++c) {
    for (int k = 0; k < kCorners; ++k)
      mesh.positions.row(c * kCorners + k) = on_circle(radius_and_z[static_cast<std::size_t>(c)].first, k,
                                                       radius_and_z[static_cast<std::size_t>(c)].second);
  }
  for (int c = 0; c < (ring ? curves : curves - 1); ++c) {
    for (int k = 0; k < kCorners; ++k) {
      const int a = c * kCorners + k, b = c * kCorners + (k + 1) % kCorners;
      const int next = (c + 1) % curves, d = next * kCorners + k, e = next * kCorners + (k + 1) % kCorners;
      triangles.push_back({a, b, e});
      triangles.push_back({a, e, d});
    }
  }
  if (!ring) {
    const int low = curves * kCorners, high = low + 1;
    mesh.positions.row(low) << 0, 0, radius_and_z.front().second;
    mesh.positions.row(high) << 0, 0, radius_and_z.back().second;
    for (int k = 0; k < kCorners; ++k) {
      const int next = (k + 1) % kCorners, top = (curves - 1) * kCorners;
      triangles.push_back({low, next, k});
      triangles.push_back({high, top + k, top + next});
    }
  }
  mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    mesh.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  return mesh;
}

/// A round peg in a hole, both far above the gel. The hole's mouth is at z = kMouth, the peg's tip a depth below it.
class PegInHole : public Bodies {
 protected:
  static constexpr double kMouth = 0.05, kHole = 5e-3, kPeg = 4.975e-3, kLength = 20e-3, kPegDHat = 2e-6;
  void add_peg(double depth_m) {
    const double tip = kMouth - depth_m;
    add(turned({{kPeg, tip}, {kPeg, tip + kLength}}, false), true);
    settings_.laws = ContactLaws({.friction = kMu, .d_hat_m = kPegDHat});
    settings_.barrier_stiffness_j_m4 = 0.5 / std::pow(kPegDHat, 3);
    settings_.friction->speed_threshold_m_s = 1e-5;
  }
  /// Part of the hole between two heights: around its wall, its upper rim, the outside and the back.
  void add_hole(double top, double bottom) {
    add(turned({{kHole, top}, {kHole, bottom}, {8e-3, bottom}, {8e-3, top}}, true), false);
  }
};

class JammingPeg : public PegInHole, public ::testing::WithParamInterface<double> {};

// Two points carry the peg: the mouth on one side, its tip on the other. With a load (F_x, −F_z) at the centre of mass,
// L above the tip, it slides in if F_z > μ F_x (2 L − 2 μ r − ℓ)/ℓ, from the balance of forces and moments with both
// contacts at the edge of sliding: the line M/(r F_z) = λ + μ (1 + λ) F_x/F_z of Whitney 1982, λ = ℓ/(2 r μ).
TEST_P(JammingPeg, JamsWhereWhitneySays) {
  constexpr double kDepth = 5e-3, kArm = 0.5 * kLength;
  const double mu = GetParam(), limit = kDepth / (mu * (2.0 * kArm - 2.0 * mu * kPeg - kDepth));  // F_x/F_z
  add_peg(kDepth);
  add_hole(kMouth, kMouth - 12e-3);
  settings_.laws = ContactLaws({.friction = mu, .d_hat_m = kPegDHat});
  build();
  const State start = state_;
  const auto sunk_under = [&](double ratio) {
    state_ = start;
    load_n_ = {Vector3(ratio, 0, -1.0)};
    go(60, Vector3::Zero());
    return center_of(bodies_[0].rest_m).z() - center_of(points(0)).z();
  };
  EXPECT_LT(sunk_under(1.05 * limit), 0.2e-3);
  EXPECT_GT(sunk_under(0.95 * limit), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Friction, JammingPeg, ::testing::Values(0.3, kMu));

/// The peg is tilted until mouth and wall press on it from both sides, and let go without any load. What they press it
/// with, N at a distance of ℓ along the hole, turns it upright; friction on both sides of the diameter d holds it if
/// N ℓ < μ N d.
class WedgedPeg : public PegInHole {
 protected:
  static constexpr int kPart = 5;           // steps between two looks
  static constexpr double kCreep = 1e-6;    // ε_v: what it creeps hardly lets the force sink
  static constexpr double kStep = 2e-4;     // it comes free within a few steps
  static constexpr double kPressed = 0.25;  // gaps, in d̂
  struct Looks {
    std::vector<double> mouth_n, wall_n, tilt_rad;
  };
  /// \param r ℓ over μ d
  Looks let_go(double r) {
    const double depth = r * 2.0 * kMu * kPeg, middle = kMouth - 0.5 * depth;
    add_peg(depth);
    add_hole(kMouth, middle + 0.1e-3);
    add_hole(middle - 0.1e-3, kMouth - 12e-3);
    // A force so small that it moves the peg by less than d̂ in a step.
    settings_.barrier_stiffness_j_m4 = 1.5e-3 / std::pow(kPegDHat, 3);
    settings_.friction->speed_threshold_m_s = kCreep;
    h_s_ = kStep;
    build();
    tilt(depth, kPressed * kPegDHat);
    Looks looks;
    for (int i = 0; i < 9; ++i) {
      go(i == 0 ? 1 : kPart, Vector3::Zero());
      looks.mouth_n.push_back(on(0, 1).force_n.norm());
      looks.wall_n.push_back(on(0, 2).force_n.norm());
      const Vector3 axis = deformation_of(bodies_[0], points(0)).col(2);
      looks.tilt_rad.push_back(std::atan2(axis.x(), axis.z()));
    }
    return looks;
  }

 private:
  /// Turns the peg about the point half-way down to its tip, and shifts it, until mouth and tip are both `gap_m` away
  /// from the other: (D/2 − s) cos θ − d/2 − ℓ/2 sin θ the mouth from the peg's side, D/2 + s − d/2 cos θ − ℓ/2 sin θ
  /// the tip from the wall, alike where the shift s is −(D + d)/2 tan²(θ/2).
  void tilt(double depth_m, double gap_m) {
    const auto shift = [](double angle) { return -(kHole + kPeg) * std::pow(std::tan(0.5 * angle), 2); };
    double low = 0.0, high = 0.1;
    for (int i = 0; i < 60; ++i) {
      const double angle = 0.5 * (low + high);
      const double gap = kHole + shift(angle) - kPeg * std::cos(angle) - 0.5 * depth_m * std::sin(angle);
      (gap > gap_m ? low : high) = angle;
    }
    const Matrix3 turn = Eigen::AngleAxisd(low, Vector3::UnitY()).toRotationMatrix();
    const Eigen::RowVector3d from(0, 0, kMouth - 0.5 * depth_m), to = from + Eigen::RowVector3d(shift(low), 0, 0);
    const auto place = [&](auto rows) { rows = (((rows.rowwise() - from) * turn.transpose()).rowwise() + to).eval(); };
    place(mesh_.objects[0].rows(state_.x));
    place(state_.x.middleRows<4>(mesh_.control_row(0)));
  }
};

/// Friction that is not at its limit creeps at ε_v (1 − √(1 − r)), which turns the peg by that over d/2.
TEST_F(WedgedPeg, StaysIfItIsLessDeepThanFrictionTimesItsDiameter) {
  constexpr double r = 0.95;
  const Looks looks = let_go(r);
  const double first_n = looks.mouth_n[0];
  EXPECT_GT(first_n, 0.2);
  for (std::size_t i = 0; i < looks.mouth_n.size(); ++i) {
    EXPECT_GT(looks.mouth_n[i], 0.95 * first_n) << i;
    EXPECT_NEAR(looks.wall_n[i], looks.mouth_n[i], 0.02 * first_n) << i;
  }
  const double turned = looks.tilt_rad[2] - looks.tilt_rad.back();
  const double time_s = kStep * kPart * (static_cast<double>(looks.tilt_rad.size()) - 3.0);
  const double expected = kCreep * (1.0 - std::sqrt(1.0 - r)) / kPeg * time_s;
  // Three parts in a hundred of the friction: neighbouring corners of the round peg press askew.
  EXPECT_NEAR(turned, expected, 0.08 * expected);
}

TEST_F(WedgedPeg, ComesFreeIfItIsDeeper) {
  const Looks looks = let_go(1.05);
  EXPECT_GT(looks.mouth_n[0], 0.2);
  EXPECT_EQ(looks.mouth_n.back(), 0.0);
  EXPECT_EQ(looks.wall_n.back(), 0.0);
  EXPECT_LT(looks.tilt_rad.back(), 0.99 * looks.tilt_rad.front());
}

}  // namespace time_step_bodies_test
}  // namespace tacipc
