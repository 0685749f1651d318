// Several deformable bodies as the solver sees them.
#include "stages/gel/press/world/setup.h"

#include <gtest/gtest.h>

#include "stages/gel/press/energy/elasticity.h"
#include "stages/gel/press/solve/assembly.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace setup_test {

const Material kSoft{.law = "neo_hookean", .density_kg_m3 = 1010.0, .youngs_modulus_pa = 1.2e5, .poissons_ratio = 0.48};
const Material kFoam{.law = "stvk_hencky",
                     .density_kg_m3 = 300.0,
                     .youngs_modulus_pa = 3e4,
                     .poissons_ratio = 0.2,
                     .relaxation = {{0.4, 0.02}}};
const Material kPutty{.law = "neo_hookean",
                      .density_kg_m3 = 1500.0,
                      .youngs_modulus_pa = 5e4,
                      .poissons_ratio = 0.4,
                      .relaxation = {{0.2, 0.1}, {0.3, 0.01}}};

TetMesh moved(TetMesh mesh, double along_x_m) {
  mesh.positions.col(0).array() += along_x_m;
  return mesh;
}

/// Vertices of the back are no mount.
TetMesh without_mount(TetMesh mesh) {
  for (BoundaryTag& tag : mesh.tags) {
    if (tag == BoundaryTag::glued) tag = BoundaryTag::side;
  }
  return mesh;
}

TEST(GelModel, OfSeveralBodiesHasTheMassesAndMountsOfEachInTheirOrder) {
  const TetMesh gel = block_gel(3, 0.006, 0.002), ball = without_mount(moved(block_gel(2, 0.004, 0.002), 0.01));
  const GelModel one = make_gel_model({{kSoft, "averaged_volume", gel}}),
                 other = make_gel_model({{kFoam, "linear", ball}}),
                 both = make_gel_model({{kSoft, "averaged_volume", gel}, {kFoam, "linear", ball}});
  const Eigen::Index n = gel.num_vertices(), m = ball.num_vertices();
  EXPECT_EQ(both.mass_kg.head(n), one.mass_kg);
  EXPECT_EQ(both.mass_kg.tail(m), other.mass_kg);
  EXPECT_NEAR(other.mass_kg.sum(), 300.0 * 0.004 * 0.004 * 0.002, 1e-15);
  EXPECT_EQ(both.glued, gel.vertices(BoundaryTag::glued));
  EXPECT_TRUE(other.glued.empty());
  EXPECT_EQ(both.tets.topRows(gel.num_tets()), gel.tets);
  EXPECT_EQ(both.tets.bottomRows(ball.num_tets()), Tetrahedra(ball.tets.array() + static_cast<int>(n)));
  EXPECT_EQ(one.viscoelasticity, nullptr);
  ASSERT_NE(both.viscoelasticity, nullptr);
  EXPECT_EQ(both.viscoelasticity->elastic_factors(0.01).front(), 1.0);
  EXPECT_GT(both.viscoelasticity->elastic_factors(0.01).back(), 1.3);
}

/// Swings under its weight, the first one only about its mount: elastic, and relaxing by series of its own.
class Swinging : public ::testing::TestWithParam<LinearSolverKind> {
 protected:
  struct End {
    Positions x, velocity_m_s, mount_n;
  };
  static End swing(const std::vector<DeformableBody>& bodies) {
    std::vector<TetMesh> meshes;
    for (const DeformableBody& body : bodies) meshes.push_back(body.mesh);
    const TetMesh all = joined(meshes);
    // An object that is nowhere near.
    TriangleMesh object = pyramid(0.003, 0.002);
    object.positions.col(2).array() += 0.1;
    const ContactMesh mesh = make_contact_mesh(all.positions, all.boundary, {object});
    TimeStepper stepper(mesh, make_gel_model(bodies),
                        {.laws = ContactLaws({.d_hat_m = 2e-5}),
                         .front_edge_m = 1e-3,
                         .barrier_stiffness_j_m4 = 1e13,
                         .gravity_m_s2 = {400.0, 0.0, -900.0},
                         .linear_solver = GetParam(),
                         .newton = {.velocity_tolerance_m_s = 1e-13, .force_tolerance_n = 1e-11}});
    State state{.x = mesh.rest_positions, .velocity_m_s = Positions::Zero(all.num_vertices(), 3)};
    for (int step = 0; step < 6; ++step)
      stepper.advance(state, {.h_s = 0.0004, .object_target = object.positions}, [](int, double) {});
    return {state.x.topRows(all.num_vertices()), state.velocity_m_s, stepper.forces().mount};
  }
};

TEST_P(Swinging, BodiesFarApartGoAsEachDoesAlone) {
  const TetMesh first = block_gel(3, 0.006, 0.002), second = without_mount(moved(block_gel(2, 0.004, 0.002), 0.02)),
                third = moved(block_gel(2, 0.004, 0.003), -0.02);
  const std::vector<DeformableBody> bodies{
      {kSoft, "averaged_volume", first}, {kFoam, "linear", second}, {kPutty, "averaged_volume", third}};
  const End together = swing(bodies);
  Eigen::Index row = 0;
  for (const DeformableBody& body : bodies) {
    const End alone = swing({body});
    const Eigen::Index n = body.mesh.num_vertices();
    const double way = (alone.x - body.mesh.positions).norm();
    EXPECT_GT(way, 1e-4);
    EXPECT_LT((together.x.middleRows(row, n) - alone.x).norm(), 1e-8 * way);
    EXPECT_LT((together.velocity_m_s.middleRows(row, n) - alone.velocity_m_s).norm(), 1e-6 * alone.velocity_m_s.norm());
    EXPECT_LE((together.mount_n.middleRows(row, n) - alone.mount_n).norm(), 1e-6 * alone.mount_n.norm());
    row += n;
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, Swinging,
                         ::testing::Values(LinearSolverKind::direct, LinearSolverKind::conjugate_gradient),
                         [](const auto& test) { return test.param == LinearSolverKind::direct ? "direct" : "cg"; });

}  // namespace setup_test
}  // namespace tacipc
