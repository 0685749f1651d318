// Two gels pressed together front to front, one the mirror image of the other.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "stages/gel/press/world/setup.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace time_step_mirrored_gels_test {

constexpr double kH = 0.01, kThickness = 0.002;
constexpr double kDHat = 2e-4;  // large: vertices that face each other stay so only if little force brings them near

const Material kGel{.law = "neo_hookean", .density_kg_m3 = 1010.0, .youngs_modulus_pa = 1.2e5, .poissons_ratio = 0.43};

/// A block whose front is a little uneven, alike in no direction.
TetMesh uneven_gel() {
  TetMesh gel = block_gel(6, 0.006, kThickness);
  for (Eigen::Index v = 0; v < gel.num_vertices(); ++v) {
    const double x = gel.positions(v, 0), y = gel.positions(v, 1), part = 1.0 + gel.positions(v, 2) / kThickness;
    gel.positions(v, 2) += part * 3e-5 * std::sin(700.0 * x + 0.4) * std::cos(500.0 * y - 0.3);
  }
  return gel;
}

/// The mirror image in x, its tetrahedra and triangles turned so that they look outwards again.
TetMesh mirrored(TetMesh gel) {
  gel.positions.col(0) *= -1.0;
  gel.tets.col(0).swap(gel.tets.col(1));
  gel.boundary.col(0).swap(gel.boundary.col(1));
  return gel;
}

/// Half a turn about y: with the mirror image in x, the mirror image in z.
const Matrix3 kTurn = Vector3(-1.0, 1.0, -1.0).asDiagonal();

/// Pairs counted once, or each by itself.
class MirroredGels : public ::testing::TestWithParam<bool> {
 protected:
  MirroredGels() {
    plane_m_ = below_.positions.col(2).maxCoeff() + 0.6 * kDHat;
    above_ = mirrored(below_);
    const TetMesh other = above_;
    above_.positions *= kTurn;
    above_.positions.col(2).array() += 2.0 * plane_m_;
    const TetMesh all = joined({below_, above_});
    mesh_ = make_contact_mesh(all.positions, all.boundary, {});
    const auto alone = [](const TetMesh& body) {
      return std::make_shared<const ContactMesh>(make_contact_mesh(body.positions, body.boundary, {}));
    };
    const auto n = static_cast<int>(below_.num_vertices());
    mesh_.gels = {{0, below_.vertices(BoundaryTag::glued).front(), alone(below_)},
                  {n, above_.vertices(BoundaryTag::glued).front(), alone(other)}};
    state_ = {.x = mesh_.rest_positions, .velocity_m_s = Positions::Zero(2 * n, 3)};
    mounts_ = mesh_.rest_positions;
  }

  /// A step towards each other and, both alike, along the plane between them.
  void go(TimeStepper& stepper, const GelModel& model) {
    const Eigen::Index n = below_.num_vertices();
    Positions motion(2 * n, 3);
    motion.topRows(n).rowwise() = Eigen::RowVector3d(2e-5, -1e-5, 2e-5);
    motion.bottomRows(n).rowwise() = Eigen::RowVector3d(2e-5, -1e-5, -2e-5);
    mounts_ += motion;
    stepper.advance(state_,
                    {.h_s = kH,
                     .object_target = Positions(0, 3),
                     .gel_motion = motion,
                     .glued_target = mounts_(model.glued, Eigen::all),
                     .world_from_gel = {Matrix3::Identity(), kTurn}},
                    [](int, double) {});
  }
  /// How far from the other's mirror image rows of the upper gel are at most: those of positions, or of forces.
  double apart(const Positions& rows, double plane) const {
    const Eigen::Index n = below_.num_vertices();
    Positions image = rows.bottomRows(n);
    image.col(2) = 2.0 * plane - image.col(2).array();
    return (image - rows.topRows(n)).cwiseAbs().maxCoeff();
  }
  void expect_mirror_images(int steps, std::optional<FrictionSettings> friction, double least_force_n) {
    const StepSettings settings{
        .laws = ContactLaws({.friction = 0.5, .d_hat_m = kDHat}),
        .front_edge_m = 1e-3,
        .barrier_stiffness_j_m4 = 1e9,
        .pair_counting = {.once = GetParam()},
        .friction = friction,
        .wrenches_between_bodies = true,
        .linear_solver = LinearSolverKind::direct,
        .newton = {.velocity_tolerance_m_s = 1e-10, .relative_force_tolerance = 0.0, .force_tolerance_n = 1e-9}};
    const GelModel model = make_gel_model({{kGel, "averaged_volume", below_}, {kGel, "averaged_volume", above_}});
    TimeStepper stepper(mesh_, model, settings);
    for (int step = 0; step < steps; ++step) {
      go(stepper, model);
      EXPECT_LT(apart(state_.x, plane_m_), 1e-12) << step;
      EXPECT_LT(apart(stepper.forces().normal, 0.0), 1e-10) << step;
      const Vector3 on_below = stepper.forces().between[1].force_n, on_above = stepper.forces().between[2].force_n;
      EXPECT_LT((on_below + on_above).norm(), 1e-12) << step;
      EXPECT_LT(on_below.head<2>().norm(), 1e-10) << step;
      if (step == steps - 1) {
        EXPECT_GT(-on_below.z(), least_force_n);
      }
    }
  }

  const TetMesh below_ = uneven_gel();
  TetMesh above_;
  double plane_m_;
  ContactMesh mesh_;
  State state_;
  Positions mounts_;  // rest positions, moved with the mounts
};

/// Neither slides on the other, so friction does nothing but keep vertices that face each other where they are.
TEST_P(MirroredGels, StayMirrorImages) {
  expect_mirror_images(
      6, FrictionSettings{.speed_threshold_m_s = 2e-5, .max_lag_iterations = 50, .relative_lag_tolerance = 1e-3}, 0.19);
}

/// Without it two vertices that press on each other head on stay there only as long as their force over their distance
/// is less than the gel's stiffness sideways; beyond, the mirror image is no longer a minimum of the energy.
TEST_P(MirroredGels, StayMirrorImagesWithoutFrictionUnderALightPress) { expect_mirror_images(3, std::nullopt, 0.03); }

INSTANTIATE_TEST_SUITE_P(Once, MirroredGels, ::testing::Bool());

}  // namespace time_step_mirrored_gels_test
}  // namespace tacipc
