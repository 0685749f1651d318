// Gels that their mounts carry: against the same motion of the object, and two of them with a free object between.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "stages/gel/press/energy/element.h"
#include "stages/gel/press/solve/time_step.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace {

constexpr double kH = 0.01, kDHat = 2e-5;

GelModel model_of(const TetMesh& gel, Element element) {
  return {.elasticity = make_elasticity(gel.positions, gel.tets, NeoHookean{4.3e4, 2.6e5}, element),
          .tets = gel.tets,
          .mass_kg = lumped_masses(gel.tets, make_rest_tets(gel.positions, gel.tets), gel.num_vertices(), 1010.0),
          .glued = gel.vertices(BoundaryTag::glued)};
}

StepSettings settings(double mu) {
  return {.d_hat_m = kDHat,
          .front_edge_m = 1e-3,
          .barrier_stiffness_j_m4 = 1e13,
          .pair_counting = {.once = true},
          .friction = FrictionSettings{.coefficient = mu,
                                       .speed_threshold_m_s = 2e-5,
                                       .max_lag_iterations = 50,
                                       .relative_lag_tolerance = 1e-3},
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
  const ContactMesh mesh = make_contact_mesh(gel.positions, gel.boundary, object.positions, object.triangles);
  for (const Element element : {Element::linear, Element::averaged_volume}) {
    StepSettings quasi_static = settings(0.5);
    quasi_static.quasi_static = true;
    TimeStepper of_object(mesh, model_of(gel, element), quasi_static), of_gel(mesh, model_of(gel, element), quasi_static);
    const State start{.x = mesh.rest_positions, .velocity_m_s = Positions::Zero(gel.num_vertices(), 3)};
    State moved_object = start, moved_gel = start;
    Vector3 shift = Vector3::Zero();
    for (const Vector3& by : {Vector3(0, 0, -1.5e-4), Vector3(0, 0, -1.5e-4), Vector3(1e-4, 5e-5, 0)}) {
      shift += by;
      of_object.advance(moved_object,
                        {.h_s = kH, .object_target = object.positions.rowwise() + shift.transpose()},
                        [](int, double) {});
      const GelModel gel_model = model_of(gel, element);
      const Positions rest = gel.positions.rowwise() - shift.transpose();
      of_gel.advance(moved_gel,
                     {.h_s = kH,
                      .object_target = object.positions,
                      .gel_motion = Positions(Positions::Zero(gel.num_vertices(), 3).rowwise() - by.transpose()),
                      .glued_target = glued_rows(gel_model, rest)},
                     [](int, double) {});
      const Positions apart =
          (moved_gel.x.topRows(gel.num_vertices()).rowwise() + shift.transpose()) - moved_object.x.topRows(gel.num_vertices());
      EXPECT_LT(apart.rowwise().norm().maxCoeff(), 2e-8);
      const Vector3 a = of_object.forces().normal.colwise().sum() + of_object.forces().friction.colwise().sum();
      const Vector3 b = of_gel.forces().normal.colwise().sum() + of_gel.forces().friction.colwise().sum();
      EXPECT_GT(a.norm(), 1e-3);
      EXPECT_LT((a - b).norm(), 1e-3 * a.norm());
      EXPECT_EQ(glued_rows(gel_model, moved_gel.x), glued_rows(gel_model, rest));
    }
  }
}

}  // namespace
}  // namespace tacipc
