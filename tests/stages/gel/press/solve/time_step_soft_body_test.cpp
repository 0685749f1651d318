// A soft body that nothing holds, on a gel of another material.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "stages/gel/press/world/setup.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace time_step_soft_body_test {

constexpr double kH = 0.002, kDHat = 2e-5, kGravity = 10.0;

const Material kGel{.law = "neo_hookean", .density_kg_m3 = 1010.0, .youngs_modulus_pa = 1.2e5, .poissons_ratio = 0.43};
const Material kFoam{.law = "neo_hookean", .density_kg_m3 = 500.0, .youngs_modulus_pa = 4e4, .poissons_ratio = 0.2};

class SoftBody : public ::testing::Test {
 protected:
  SoftBody() {
    for (BoundaryTag& tag : foam_.tags) tag = BoundaryTag::free;
    foam_.positions.rowwise() += Eigen::RowVector3d(3e-4, 2e-4, 0.002 + 2.5 * kDHat);
    object_.positions.col(2).array() += 0.1;
    const TetMesh all = joined({gel_, foam_});
    mesh_ = make_contact_mesh(all.positions, all.boundary, {object_});
    const auto alone = [](const TetMesh& body) {
      return std::make_shared<const ContactMesh>(make_contact_mesh(body.positions, body.boundary, {}));
    };
    mesh_.gels = {{0, gel_.vertices(BoundaryTag::glued).front(), alone(gel_)},
                  {static_cast<int>(gel_.num_vertices()), -1, alone(foam_)}};
    state_ = {.x = mesh_.rest_positions, .velocity_m_s = Positions::Zero(all.num_vertices(), 3)};
  }

  void rest(TimeStepper& stepper, int steps) {
    for (int step = 0; step < steps; ++step)
      stepper.advance(state_, {.h_s = kH, .object_target = object_.positions}, [](int, double) {});
  }
  /// Under a weight that leans by `slope`.
  StepSettings settings(double mu, double slope) const {
    return {.laws = ContactLaws({.friction = mu, .d_hat_m = kDHat}),
            .front_edge_m = 1e-3,
            .barrier_stiffness_j_m4 = 1e11,
            .pair_counting = {.once = true},
            .friction =
                FrictionSettings{.speed_threshold_m_s = 2e-5, .max_lag_iterations = 50, .relative_lag_tolerance = 1e-3},
            .gravity_m_s2 = kGravity * Vector3(slope, 0.0, -1.0).normalized(),
            .linear_solver = LinearSolverKind::conjugate_gradient,
            .newton = {.velocity_tolerance_m_s = 1e-6, .relative_force_tolerance = 1e-5, .force_tolerance_n = 1e-8}};
  }
  Vector3 force_on_foam(const TimeStepper& stepper) const {
    const auto n = foam_.num_vertices();
    return (stepper.forces().normal + stepper.forces().friction).bottomRows(n).colwise().sum();
  }
  Vector3 force_on_gel(const TimeStepper& stepper) const {
    const auto n = gel_.num_vertices();
    return (stepper.forces().normal + stepper.forces().friction).topRows(n).colwise().sum();
  }
  double foam_speed() const { return state_.velocity_m_s.bottomRows(foam_.num_vertices()).rowwise().norm().maxCoeff(); }

  const TetMesh gel_ = block_gel(6, 0.006, 0.002);
  TetMesh foam_ = block_gel(3, 0.003, 0.002);
  const double weight_n_ = 500.0 * 0.003 * 0.003 * 0.002 * kGravity;
  TriangleMesh object_ = pyramid(0.003, 0.002);  // nowhere near
  ContactMesh mesh_;
  State state_;
};

TEST_F(SoftBody, RestsOnAGelWithItsWeight) {
  const StepSettings flat = settings(0.5, 0.0);
  TimeStepper stepper(mesh_, make_gel_model({{kGel, "averaged_volume", gel_}, {kFoam, "linear", foam_}}), flat);
  rest(stepper, 60);
  EXPECT_LT(foam_speed(), 1e-4);
  EXPECT_LT((force_on_foam(stepper) - Vector3(0, 0, weight_n_)).norm(), 1e-2 * weight_n_);
  EXPECT_LT((force_on_foam(stepper) + force_on_gel(stepper)).norm(), 1e-4 * weight_n_);
  // Its lower half carries more than its upper one, and is flatter.
  const auto height = [&](int layer) {
    const Eigen::Index n = foam_.num_vertices() / 3;
    const auto rows = state_.x.middleRows(gel_.num_vertices(), foam_.num_vertices());
    return rows.middleRows((layer + 1) * n, n).col(2).mean() - rows.middleRows(layer * n, n).col(2).mean();
  };
  EXPECT_LT(height(0), height(1));
  EXPECT_LT(height(1), 1e-3);
}

TEST_F(SoftBody, SticksOrSlidesByFrictionOnAGel) {
  const GelModel model = make_gel_model({{kGel, "averaged_volume", gel_}, {kFoam, "linear", foam_}});
  const StepSettings sticky = settings(0.5, 0.3), slippery = settings(0.2, 0.3);
  TimeStepper first(mesh_, model, sticky);
  const State start = state_;
  rest(first, 60);
  EXPECT_LT(foam_speed(), 1e-4);
  EXPECT_NEAR(-force_on_foam(first).x() / force_on_foam(first).z(), 0.3, 3e-3);
  state_ = start;
  TimeStepper second(mesh_, model, slippery);
  rest(second, 20);
  EXPECT_GT(foam_speed(), 0.01);
  EXPECT_NEAR(-force_on_foam(second).x() / force_on_foam(second).z(), 0.2, 2e-2);
}

}  // namespace time_step_soft_body_test
}  // namespace tacipc
