// Gels that their mounts carry: against the same motion of the object, and two of them with a free object between.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/solve/time_step.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace time_step_mounts_test {

constexpr double kH = 0.01, kDHat = 2e-5;

GelModel model_of(const TetMesh& gel, Element element) {
  return {.elasticity = make_elasticity(gel.positions, gel.tets, NeoHookean{4.3e4, 2.6e5}, element),
          .tets = gel.tets,
          .mass_kg = lumped_masses(gel.tets, make_rest_tets(gel.positions, gel.tets), gel.num_vertices(), 1010.0),
          .glued = gel.vertices(BoundaryTag::glued)};
}

StepSettings settings(double mu) {
  return {.laws = ContactLaws({.friction = mu, .d_hat_m = kDHat}),
          .front_edge_m = 1e-3,
          .barrier_stiffness_j_m4 = 1e13,
          .pair_counting = {.once = true},
          .friction =
              FrictionSettings{.speed_threshold_m_s = 2e-5, .max_lag_iterations = 50, .relative_lag_tolerance = 1e-3},
          .linear_solver = LinearSolverKind::conjugate_gradient,
          .newton = {.velocity_tolerance_m_s = 1e-6, .relative_force_tolerance = 1e-6, .force_tolerance_n = 1e-6}};
}

Positions glued_rows(const GelModel& gel, const Positions& at) { return at(gel.glued, Eigen::all); }

/// Pressed and dragged by its mount against an object that stands still, a gel does what it does where the object moves
/// the other way.
TEST(MovingMount, IsTheObjectsMotionTheOtherWay) {
  const TetMesh gel = block_gel(8, 0.02, 0.002);
  TriangleMesh object = pyramid(0.003, 0.002);
  object.positions.rowwise() += Eigen::RowVector3d(4e-4, 2e-4, 1.5e-5);
  const ContactMesh mesh = make_contact_mesh(gel.positions, gel.boundary, {object});
  for (const Element element : {Element::linear, Element::averaged_volume}) {
    StepSettings quasi_static = settings(0.5);
    quasi_static.quasi_static = true;
    TimeStepper of_object(mesh, model_of(gel, element), quasi_static),
        of_gel(mesh, model_of(gel, element), quasi_static);
    const State start{.x = mesh.rest_positions, .velocity_m_s = Positions::Zero(gel.num_vertices(), 3)};
    State moved_object = start, moved_gel = start;
    Vector3 shift = Vector3::Zero();
    for (const Vector3& by : {Vector3(0, 0, -1.5e-4), Vector3(0, 0, -1.5e-4), Vector3(1e-4, 5e-5, 0)}) {
      shift += by;
      of_object.advance(moved_object, {.h_s = kH, .object_target = object.positions.rowwise() + shift.transpose()},
                        [](int, double) {});
      const GelModel gel_model = model_of(gel, element);
      const Positions rest = gel.positions.rowwise() - shift.transpose();
      of_gel.advance(moved_gel,
                     {.h_s = kH,
                      .object_target = object.positions,
                      .gel_motion = Positions(Positions::Zero(gel.num_vertices(), 3).rowwise() - by.transpose()),
                      .glued_target = glued_rows(gel_model, rest)},
                     [](int, double) {});
      const Positions apart = (moved_gel.x.topRows(gel.num_vertices()).rowwise() + shift.transpose()) -
                              moved_object.x.topRows(gel.num_vertices());
      EXPECT_LT(apart.rowwise().norm().maxCoeff(), 2e-8);
      const Vector3 a = of_object.forces().normal.colwise().sum() + of_object.forces().friction.colwise().sum();
      const Vector3 b = of_gel.forces().normal.colwise().sum() + of_gel.forces().friction.colwise().sum();
      EXPECT_GT(a.norm(), 1e-3);
      EXPECT_LT((a - b).norm(), 1e-3 * a.norm());
      EXPECT_EQ(glued_rows(gel_model, moved_gel.x), glued_rows(gel_model, rest));
    }
  }
}

/// Two gels in one mesh, the right one the left one's mirror image, with their fronts towards each other along x.
TetMesh two_gels(const TetMesh& gel, double front_x_m) {
  const Eigen::Index n = gel.num_vertices();
  TetMesh both;
  both.positions.resize(2 * n, 3);
  for (Eigen::Index v = 0; v < n; ++v) {
    // z of S is x of the world for the left one.
    const double x = gel.positions(v, 2) - front_x_m, y = gel.positions(v, 0), z = gel.positions(v, 1);
    both.positions.row(v) << x, y, z;
    both.positions.row(n + v) << -x, y, z;
  }
  both.tets.resize(2 * gel.tets.rows(), 4);
  both.tets << gel.tets, gel.tets.array() + static_cast<int>(n);
  both.tets.bottomRows(gel.tets.rows()).col(0).swap(both.tets.bottomRows(gel.tets.rows()).col(1));
  both.boundary.resize(2 * gel.boundary.rows(), 3);
  both.boundary << gel.boundary, gel.boundary.array() + static_cast<int>(n);
  both.boundary.bottomRows(gel.boundary.rows()).col(0).swap(both.boundary.bottomRows(gel.boundary.rows()).col(1));
  both.tags = gel.tags;
  both.tags.insert(both.tags.end(), gel.tags.begin(), gel.tags.end());
  return both;
}

/// A block between two gels: gripped while it is held, let go, lifted.
class TwoFingers : public ::testing::Test {
 protected:
  static constexpr double kHalf = 0.004, kG = 9.81;
  explicit TwoFingers(double mu = 0.8, double density_kg_m3 = 8000.0)
      : body_(make_affine_body(box_.positions, box_.triangles, density_kg_m3)), settings_(settings(mu)) {
    mesh_.num_control_points = 4;
    state_.x.resize(mesh_.num_rows(), 3);
    state_.x << mesh_.rest_positions, body_.rest_m;
    state_.velocity_m_s = Positions::Zero(gels_.num_vertices(), 3);
    settings_.gravity_m_s2 = Vector3(0, 0, -kG);
  }
  /// One step in which both fingers go towards each other, and up.
  StepReport go(double closing_m, double lift_m, bool free) {
    if (!stepper_) stepper_.emplace(mesh_, model_, settings_, std::vector{body_});
    const Eigen::Index n = gel_.num_vertices();
    Positions motion(2 * n, 3);
    motion.topRows(n).rowwise() = Eigen::RowVector3d(closing_m, 0, lift_m);
    motion.bottomRows(n).rowwise() = Eigen::RowVector3d(-closing_m, 0, lift_m);
    at_ += motion;
    const StepReport report = stepper_->advance(state_,
                                                {.h_s = kH,
                                                 .object_target = box_.positions,
                                                 .free_object = free,
                                                 .gel_motion = motion,
                                                 .glued_target = glued_rows(model_, at_),
                                                 .control_target = body_.rest_m},
                                                [](int, double) {});
    largest_residual_n_ = std::max(largest_residual_n_, report.body_residual_n);
    return report;
  }
  /// On one of the gels.
  Vector3 force(int side, bool friction_too = true) const {
    const StepForces& forces = stepper_->forces();
    const Eigen::Index n = gel_.num_vertices();
    Vector3 sum = forces.normal.middleRows(side * n, n).colwise().sum();
    if (friction_too) sum += Vector3(forces.friction.middleRows(side * n, n).colwise().sum());
    return sum;
  }
  double height() const { return center_of(mesh_.control_rows(state_.x)).z(); }
  double weight_n() const { return body_.mass_kg * kG; }

  const TetMesh gel_ = block_gel(6, 0.02, 0.002);
  const TetMesh gels_ = two_gels(gel_, kHalf + 0.6 * kDHat);
  const TriangleMesh box_ = make_box({-kHalf, -kHalf, -kHalf}, {kHalf, kHalf, kHalf});
  const GelModel model_ = model_of(gels_, Element::linear);
  ContactMesh mesh_ = make_contact_mesh(gels_.positions, gels_.boundary, {box_});
  AffineBody body_;
  StepSettings settings_;
  State state_;
  Positions at_ = gels_.positions;
  std::optional<TimeStepper> stepper_;
  double largest_residual_n_ = 0.0;
};

TEST_F(TwoFingers, CarryABlockByTheFrictionOfBothPads) {
  for (int i = 0; i < 3; ++i) go(5e-5, 0.0, false);
  const double grip = force(0).x();
  EXPECT_LT(grip, -0.2);
  EXPECT_NEAR(force(1).x(), -grip, 1e-3 * std::abs(grip));
  for (int i = 0; i < 40; ++i) go(0.0, 0.0, true);
  // Tangential forces of the pads sum to the weight, left and right alike.
  EXPECT_NEAR(-(force(0).z() + force(1).z()), weight_n(), 1e-3 * weight_n());
  EXPECT_NEAR(force(0).z(), force(1).z(), 0.01 * weight_n());
  const double before = height();
  // Lifted by 4 mm: speeds up by 1 m/s², goes on, slows down, comes to rest.
  double speed = 0.0, lifted = 0.0;
  for (int i = 0; i < 30; ++i) {
    speed += i < 2 ? 0.01 : i >= 20 && i < 22 ? -0.01 : 0.0;
    lifted += kH * speed;
    go(0.0, kH * speed, true);
  }
  EXPECT_NEAR(height() - before, lifted, 0.05e-3);
  EXPECT_GT(lifted, 3e-3);
  EXPECT_NEAR(-(force(0).z() + force(1).z()), weight_n(), 5e-3 * weight_n());
  EXPECT_LT(largest_residual_n_, 1e-3 * weight_n());
}

class SlipperyFingers : public TwoFingers {
 protected:
  SlipperyFingers() : TwoFingers(0.05, 2e5) {}
};

TEST_F(SlipperyFingers, LoseTheBlockAndEachHoldsMuTimesItsGripMeanwhile) {
  for (int i = 0; i < 3; ++i) go(5e-5, 0.0, false);
  ASSERT_LT(2 * 0.05 * std::abs(force(0).x()), 0.5 * weight_n());
  const double before = height();
  for (int i = 0; i < 2; ++i) go(0.0, 0.0, true);
  EXPECT_LT(height() - before, -0.3e-3);
  const StepForces& forces = stepper_->forces();
  for (const int side : {0, 1}) {
    const Eigen::Index n = gel_.num_vertices();
    const double normal = forces.normal.middleRows(side * n, n).rowwise().norm().sum();
    const double friction = -forces.friction.middleRows(side * n, n).col(2).sum();
    EXPECT_NEAR(friction, 0.05 * normal, 0.02 * 0.05 * normal) << side;
  }
}

}  // namespace time_step_mounts_test
}  // namespace tacipc
