// The general assembly of Newton's system: its pattern, its derivative, gel against gel.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "stages/gel/press/solve/assembly.h"
#include "stages/gel/press/solve/cholmod_solver.h"
#include "tests/stages/gel/press/solve/block_matrices.h"

namespace tacipc {
namespace assembly_test {

TEST(BlockPattern, KeepsEachPairOnceWithTheDiagonalFirst) {
  const BlockPattern pattern = make_block_pattern(3, {{2, 0}, {0, 2}, {1, 2}});
  EXPECT_EQ(pattern.row, (std::vector<int>{0, 2, 1, 2, 2}));
  EXPECT_EQ(pattern.column_start, (std::vector<int>{0, 2, 4, 5}));
  EXPECT_EQ(pattern.find(2, 0), 1);
  EXPECT_EQ(pattern.find(1, 0), -1);
}

TEST(Assemble, HessianIsTheGradientsDerivativeAndCouplingThatOfPrescribedMotion) {
  const Positions rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const Tetrahedra tets{{0, 1, 2, 3}, {1, 2, 3, 4}};
  const auto elasticity = std::make_shared<Elasticity>(rest, tets, NeoHookean{2.0, 3.0});
  const IncrementalPotential potential{{{.weight = 0.7, .term = elasticity}}};
  const FreeVertices free = all_but({false, false, false, false, true});
  Positions x = rest;
  x(4, 2) = 1.3;
  x(1, 1) = 0.1;
  Positions motion = Positions::Zero(5, 3);
  motion.row(4) << 0.3, -0.2, 0.5;
  const auto pattern = mesh_pattern(free, *elasticity);
  const auto at = [&](const Positions& y) {
    NewtonSystem system;
    clear(system, free, pattern);
    for (const WeightedTerm& term : potential.terms) assemble(term, y, free, 4, Order::hessian, motion, system);
    return system;
  };
  const NewtonSystem system = at(x);
  Positions d = motion;
  Eigen::VectorXd free_d(12);
  for (int i = 0; i < 4; ++i) {
    d.row(i) << 0.2 * i - 0.3, 0.1, -0.15 * i;
    free_d.segment<3>(3 * i) = d.row(i).transpose();
  }
  const double h = 1e-5;
  const Eigen::VectorXd difference = (at(x + h * d).gradient - at(x - h * d).gradient) / (2 * h);
  const Eigen::VectorXd exact = system.hessian.multiply(free_d) + system.coupling;
  EXPECT_LT((difference - exact).norm(), 1e-8 * exact.norm());
  // The object as a whole: what its shift feels of the free vertices and of its own motion.
  const Vector3 object_difference = (at(x + h * d).object_gradient - at(x - h * d).object_gradient) / (2 * h);
  const Vector3 object_exact = system.object_border.transpose() * free_d + system.object_coupling;
  EXPECT_LT((object_difference - object_exact).norm(), 1e-8 * object_exact.norm());
  EXPECT_LT((system.object_hessian * motion.row(4).transpose() - system.object_coupling).norm(), 1e-12);
}

/// Two tetrahedra of one gel that share nothing, the tip of the second above the front of the first.
TEST(CoverContacts, GelAgainstGelExtendsThePatternOnlyWhileItIsNear) {
  const Positions rest{{0, 0, 0},     {1, 0, 0},     {0, 1, 0},     {0.2, 0.2, -1},
                       {0.3, 0.3, 1}, {0.8, 0.3, 2}, {0.3, 0.8, 2}, {0.1, 0.1, 2}};
  const Tetrahedra tets{{0, 2, 1, 3}, {4, 5, 6, 7}};
  const FreeVertices free = all_but(std::vector<bool>(8, false));
  ContactMesh mesh;
  mesh.num_gel_vertices = 8;
  mesh.rest_positions = rest;
  const ContactBarrier barrier(mesh, {{ContactPair::Kind::point_triangle, {4, 0, 1, 2}}},
                               ContactLaws({.d_hat_m = 0.4}));
  const auto pattern = mesh_pattern(free, Elasticity(rest, tets, NeoHookean{2.0, 3.0}));
  EXPECT_EQ(pattern->find(4, 0), -1);
  EXPECT_EQ(cover_contacts(pattern, free, 8, barrier, barrier.active(rest), rest), pattern);

  Positions x = rest;
  x.bottomRows(4).col(2).array() -= 0.8;  // the tip is 0.2 above the face now
  const auto covered = cover_contacts(pattern, free, 8, barrier, barrier.active(x), x);
  for (const int corner : {0, 1, 2}) EXPECT_GE(covered->find(4, corner), 0);
  EXPECT_EQ(covered->num_blocks(), pattern->num_blocks() + 3);
  EXPECT_EQ(cover_contacts(covered, free, 8, barrier, barrier.active(x), x), covered);

  // Only some of each side free, as in a patch of the gel or beside its glued face.
  const FreeVertices some = all_but({false, true, true, false, false, false, false, false});
  const auto of_some = cover_contacts(mesh_pattern(some, Elasticity(rest, tets, NeoHookean{2.0, 3.0})), some, 8,
                                      barrier, barrier.active(x), x);
  EXPECT_GE(of_some->find(some.free_of_vertex[4], some.free_of_vertex[0]), 0);

  // The extended system solves as dense algebra does, also after another pattern.
  NewtonSystem system;
  clear(system, free, covered);
  assemble({.weight = 1.0, .term = std::make_shared<ContactBarrier>(barrier)}, x, free, 8, Order::psd,
           Positions::Zero(8, 3), system);
  for (int v = 0; v < 8; ++v) system.hessian.block(covered->find(v, v)) += Matrix3::Identity();
  EXPECT_GT(system.gradient.norm(), 0.0);
  CholmodSolver solver;
  BlockMatrix identity(pattern);
  for (int v = 0; v < 8; ++v) identity.block(pattern->find(v, v)) = Matrix3::Identity();
  ASSERT_TRUE(solver.prepare(identity));
  ASSERT_TRUE(solver.prepare(system.hessian));
  EXPECT_LT((solver.solve(system.gradient).value() - dense(system.hessian).ldlt().solve(system.gradient)).norm(),
            1e-12 * system.gradient.norm());
}

}  // namespace assembly_test
}  // namespace tacipc
