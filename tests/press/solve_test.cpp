// Sparse algebra and step limits of the press.
#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <Eigen/Cholesky>
#include <random>

#include "stages/press/solve/assembly.h"
#include "stages/press/solve/blend.h"
#include "stages/press/solve/conjugate_gradient.h"
#include "stages/press/solve/step_limit.h"
#include "stages/press/solve/sweep_order.h"

namespace tacipc {
namespace {

/// A random symmetric block matrix, diagonally dominant, with some blocks off the diagonal.
BlockMatrix random_matrix(int size, unsigned seed, double diagonal) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i < size; ++i) {
    pairs.push_back({i, (i + 1) % size});
    pairs.push_back({(i * 7 + 3) % size, i});
  }
  BlockMatrix matrix(std::make_shared<BlockPattern>(make_block_pattern(size, pairs)));
  for (int c = 0; c < size; ++c) {
    for (int k = matrix.pattern->column_start[c]; k < matrix.pattern->column_start[c + 1]; ++k) {
      auto block = matrix.block(k);
      for (double& entry : block.reshaped()) entry = uniform(random);
      if (matrix.pattern->row[k] == c)
        block = (0.5 * (block + block.transpose())).eval() + diagonal * Matrix3::Identity();
    }
  }
  return matrix;
}

Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  const Eigen::Index n = 3 * matrix.pattern->size();
  Eigen::MatrixXd out(n, n);
  for (Eigen::Index i = 0; i < n; ++i) out.col(i) = matrix.multiply(Eigen::VectorXd::Unit(n, i));
  return out;
}

TEST(BlockPattern, KeepsEachPairOnceWithTheDiagonalFirst) {
  const BlockPattern pattern = make_block_pattern(3, {{2, 0}, {0, 2}, {1, 2}});
  EXPECT_EQ(pattern.row, (std::vector<int>{0, 2, 1, 2, 2}));
  EXPECT_EQ(pattern.column_start, (std::vector<int>{0, 2, 4, 5}));
  EXPECT_EQ(pattern.find(2, 0), 1);
  EXPECT_EQ(pattern.find(1, 0), -1);
}

/// A row of vertices, each coupled with the next two and a few far away.
BlockPattern chain(int size) {
  std::vector<std::array<int, 2>> pairs;
  for (int i = 0; i + 2 < size; ++i) {
    pairs.push_back({i, i + 1});
    pairs.push_back({i + 2, i});
    if (i % 97 == 5) pairs.push_back({i, (i + size / 2) % size});
  }
  return make_block_pattern(size, pairs);
}

TEST(SweepOrder, PartsShareNoBlockAndEveryBlockHasItsPlace) {
  const BlockPattern pattern = chain(1000);
  for (const int parts : {1, 2, 4}) {
    const SweepOrder order = make_sweep_order(pattern, parts);
    ASSERT_EQ(order.num_parts(), parts);
    EXPECT_EQ(order.num_rows(), 1000);
    EXPECT_TRUE(parts == 1 ? order.separator() == 1000 : order.separator() > 970 && order.separator() < 1000);
    std::vector<int> rows = order.row_of;
    std::sort(rows.begin(), rows.end());
    for (int r = 0; r < 1000; ++r) ASSERT_EQ(rows[r], r);
    const auto part_of = [&](int row) {
      return std::upper_bound(order.part_start.begin(), order.part_start.end(), row) - order.part_start.begin() - 1;
    };
    std::vector<int> seen(pattern.row.size(), 0);
    for (int c = 0; c < 1000; ++c) {
      for (int k = order.column_start[c]; k < order.column_start[c + 1]; ++k) {
        const int r = order.row[k];
        ASSERT_GT(r, c);
        EXPECT_EQ(r >= order.separator(), k >= order.separator_start[c]);
        EXPECT_TRUE(r >= order.separator() || part_of(r) == part_of(c));
        const bool turned = order.source[k] < 0;
        const int source = turned ? -1 - order.source[k] : order.source[k];
        ++seen[source];
        const auto column_of = std::upper_bound(pattern.column_start.begin(), pattern.column_start.end(), source) -
                               pattern.column_start.begin() - 1;
        const int i = order.row_of[pattern.row[source]], j = order.row_of[column_of];
        EXPECT_EQ(turned ? j : i, r);
        EXPECT_EQ(turned ? i : j, c);
      }
    }
    // All below the diagonal once, those on it never.
    for (int c = 0; c < 1000; ++c) {
      for (int k = pattern.column_start[c]; k < pattern.column_start[c + 1]; ++k)
        EXPECT_EQ(seen[k], k > pattern.column_start[c] ? 1 : 0);
    }
  }
}

TEST(CholmodSolver, SolvesAsDenseAlgebraDoesAndAnalysesOncePerPattern) {
  BlockMatrix matrix = random_matrix(40, 3, 20.0);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(120, -1.0, 2.0);
  CholmodSolver solver;
  ASSERT_TRUE(solver.prepare(matrix));
  const Eigen::MatrixXd A = dense(matrix);
  EXPECT_LT((A - A.transpose()).norm(), 1e-14 * A.norm());
  EXPECT_LT((solver.solve(b).value() - A.ldlt().solve(b)).norm(), 1e-12);
  for (double& value : matrix.values) value *= 2.0;
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_LT((A * solver.solve(b).value() * 2.0 - b).norm(), 1e-12);
  EXPECT_EQ(solver.num_analyses(), 1);
}

TEST(CholmodSolver, SaysWhenAMatrixIsNotPositiveDefiniteAndRecovers) {
  CholmodSolver solver;
  EXPECT_FALSE(solver.prepare(random_matrix(40, 3, -20.0)));
  EXPECT_FALSE(solver.prepare(random_matrix(40, 3, 0.1)));
  EXPECT_TRUE(solver.prepare(random_matrix(40, 3, 20.0)));
}

TEST(ConjugateGradient, SolvesAsDenseAlgebraDoesToItsToleranceWithoutAFactor) {
  BlockMatrix matrix = random_matrix(12, 3, 20.0);
  const Eigen::MatrixXd A = dense(matrix);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0), exact = A.ldlt().solve(b);
  for (const double tolerance : {1e-3, 1e-6, 1e-12}) {
    ConjugateGradient solver(tolerance);
    ASSERT_TRUE(solver.prepare(matrix));
    const Eigen::VectorXd x = solver.solve(b).value();
    EXPECT_LT((x - exact).norm(), 30.0 * tolerance * exact.norm());
    EXPECT_NEAR(x.dot(A * x), x.dot(b), 1e-9 * x.dot(b));  // what keeps a Newton step downhill
    EXPECT_EQ(solver.num_factorized(), 0);
    EXPECT_GT(solver.num_products(), 0);
  }
}

/// Large enough to be swept in parts.
TEST(ConjugateGradient, GivesTheSameBitsWithAnyNumberOfThreads) {
  BlockMatrix matrix(std::make_shared<BlockPattern>(chain(6000)));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int c = 0; c < 6000; ++c) {
    for (int k = matrix.pattern->column_start[c]; k < matrix.pattern->column_start[c + 1]; ++k) {
      auto block = matrix.block(k);
      for (double& entry : block.reshaped()) entry = uniform(random);
      if (matrix.pattern->row[k] == c) block = (0.5 * (block + block.transpose())).eval() + 9.0 * Matrix3::Identity();
    }
  }
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(18000, -1.0, 2.0);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    ConjugateGradient solver(1e-10);
    EXPECT_TRUE(solver.prepare(matrix));
    return solver.solve(b).value();
  };
  const Eigen::VectorXd one = with(1), two = with(2);
  EXPECT_EQ(one, two);
  EXPECT_LT((matrix.multiply(one) - b).norm(), 1e-8 * b.norm());
}

TEST(ConjugateGradient, FactorisesWhereItsProductsDoNotSuffice) {
  BlockMatrix matrix = random_matrix(12, 3, 20.0);
  const Eigen::MatrixXd A = dense(matrix);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(A.rows(), -1.0, 2.0);
  ConjugateGradient solver(1e-3, 1);
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_LT((solver.solve(b).value() - A.ldlt().solve(b)).norm(), 1e-11);
  EXPECT_EQ(solver.num_factorized(), 1);
}

TEST(ConjugateGradient, SaysWhenAMatrixIsNotPositiveDefinite) {
  BlockMatrix block = random_matrix(4, 3, 20.0);
  block.block(block.pattern->find(2, 2)) -= 100.0 * Matrix3::Identity();
  EXPECT_FALSE(ConjugateGradient().prepare(block));

  // Every block on the diagonal is positive, the whole is not.
  BlockMatrix whole(std::make_shared<const BlockPattern>(make_block_pattern(2, {{0, 1}})));
  whole.block(0) = whole.block(2) = Matrix3::Identity();
  whole.block(1) = 2.0 * Matrix3::Identity();
  ConjugateGradient solver;
  ASSERT_TRUE(solver.prepare(whole));
  Eigen::VectorXd b(6);
  b << 1, 0, 0, -1, 0, 0;
  EXPECT_FALSE(solver.solve(b).has_value());
}

TEST(ConjugateGradient, SaysWhereAMatrixIsNotPositiveDefinite) {
  BlockMatrix matrix = random_matrix(40, 3, 20.0);
  ConjugateGradient solver;
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_TRUE(solver.indefinite_rows().empty());
  // Seen at once: a block on the diagonal.
  matrix.block(17, 17)(1, 1) = -1.0;
  EXPECT_FALSE(solver.prepare(matrix));
  EXPECT_EQ(solver.indefinite_rows(), (std::vector<int>{17}));
  // Seen on the way: two that pull at each other more than they hold.
  matrix = random_matrix(40, 3, 20.0);
  matrix.block(25, 24).setIdentity();
  matrix.block(25, 24) *= 40.0;
  ASSERT_TRUE(solver.prepare(matrix));
  EXPECT_FALSE(solver.solve(Eigen::VectorXd::LinSpaced(120, -1.0, 2.0)));
  ASSERT_FALSE(solver.indefinite_rows().empty());
  for (const int row : solver.indefinite_rows()) EXPECT_TRUE(row == 24 || row == 25) << row;
}

TEST(Blend, LeansOnTheStandInAsLittleAsTheMatrixAllows) {
  Blend blend(3);
  EXPECT_EQ(blend.largest(), 1.0);
  double last = 1.0;
  for (int i = 0; i < 3 && last > 0.0; ++i, last = blend.share(1)) {
    blend.found();
    EXPECT_LT(blend.largest(), last / 3);
  }
  EXPECT_EQ(blend.largest(), 0.0);
  // Indefinite about one vertex: there, and there alone, up until all of it is leaned on.
  for (last = 0.0; blend.failed(1); last = blend.share(1)) EXPECT_GT(blend.share(1), last);
  EXPECT_EQ(blend.share(1), 1.0);
  EXPECT_EQ(blend.share(0) + blend.share(2), 0.0);
  EXPECT_EQ(blend.share(std::vector<int>{0, 1, 7}), 1.0);
  EXPECT_EQ(blend.share(std::vector<int>{0, 2, 7}), 0.0);
  // And more carefully down the more often it failed.
  for (int i = 0; i < 10; ++i) {
    blend.found();
    blend.failed(1);
  }
  while (blend.failed(1)) {
  }
  blend.found();
  EXPECT_GT(blend.share(1), 0.5);
}

TEST(Blend, AStepThatWasShortenedIsRepeatedWithMore) {
  Blend blend({0.0, 0.15, 0.0});
  blend.found();
  EXPECT_EQ(blend.largest(), 0.15 / 4);
  blend.shortened(0);
  blend.shortened(1);
  EXPECT_EQ(blend.share(0), 0.1);
  EXPECT_EQ(blend.share(1), 0.6);
  EXPECT_EQ(blend.share(2), 0.0);
}

TEST(Blend, StaysWithTheStandInUnlessAdaptive) {
  Blend blend(2, false);
  for (int i = 0; i < 5; ++i) blend.found();
  blend.shortened(0);
  EXPECT_EQ(blend.share(0), 1.0);
  EXPECT_EQ(blend.share(1), 1.0);
}

TEST(CubicStaysAbove, NeverSaysYesForACubicThatDips) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  int yes = 0, dips = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const double c[4] = {1.0, uniform(random), uniform(random), uniform(random)};
    double lowest = 1.0;
    for (int k = 0; k <= 1000; ++k) {
      const double t = 1e-3 * k;
      lowest = std::min(lowest, c[0] + t * (c[1] + t * (c[2] + t * c[3])));
    }
    const bool says = cubic_stays_above(c, 1.0, 0.1);
    EXPECT_FALSE(says && lowest <= 0.1) << c[1] << " " << c[2] << " " << c[3];
    yes += says;
    dips += lowest <= 0.1;
  }
  EXPECT_GT(yes, 1000);
  EXPECT_GT(dips, 500);
}

TEST(InversionStepLimit, StopsBeforeAVertexPassesThroughItsFace) {
  const Positions x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Positions p = Positions::Zero(4, 3);
  p(3, 2) = -4.0;  // flat at t = 1/4, a tenth of the volume left at t = 0.225
  const double t = inversion_step_limit(Tetrahedra{{0, 1, 2, 3}}, x, p);
  EXPECT_LT(t, 0.225);
  EXPECT_GT(t, 0.75 * 0.225);
  p(3, 2) = 4.0;
  EXPECT_EQ(inversion_step_limit(Tetrahedra{{0, 1, 2, 3}}, x, p), 1.0);
}

TEST(InversionStepLimit, SeesATurnThatEndsUprightAgain) {
  // Through the face and out on the other side of a moving base: positive volume at both ends, not between.
  const Positions x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Positions p = Positions::Zero(4, 3);
  p.row(1) << -2, 0, 0;
  p.row(2) << 0, -2, 0;
  EXPECT_LT(inversion_step_limit(Tetrahedra{{0, 1, 2, 3}}, x, p), 0.5);
}

TEST(Assemble, HessianIsTheGradientsDerivativeAndCouplingThatOfPrescribedMotion) {
  const Positions rest{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const Tetrahedra tets{{0, 1, 2, 3}, {1, 2, 3, 4}};
  const auto elasticity = std::make_shared<Elasticity>(rest, tets, NeoHookean{2.0, 3.0});
  const IncrementalPotential potential{{{.weight = 0.7, .term = elasticity}}};
  const FreeVertices free(5, {false, false, false, false, true});
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
  const FreeVertices free(8, std::vector<bool>(8, false));
  ContactMesh mesh;
  mesh.num_gel_vertices = 8;
  mesh.rest_positions = rest;
  const ContactBarrier barrier(mesh, {{ContactPair::Kind::point_triangle, {4, 0, 1, 2}}}, 0.4);
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
  const FreeVertices some(8, {false, true, true, false, false, false, false, false});
  const auto of_some = cover_contacts(mesh_pattern(some, Elasticity(rest, tets, NeoHookean{2.0, 3.0})), some, 8,
                                      barrier, barrier.active(x), x);
  EXPECT_GE(of_some->find(some.free_of_vertex[4], some.free_of_vertex[0]), 0);

  // The extended system solves as dense algebra does, and a new pattern is analysed anew.
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
  EXPECT_EQ(solver.num_analyses(), 2);
  EXPECT_LT((solver.solve(system.gradient).value() - dense(system.hessian).ldlt().solve(system.gradient)).norm(),
            1e-12 * system.gradient.norm());
}

}  // namespace
}  // namespace tacipc
