// Whole presses: against the reference solver, against itself, and starts that must be refused.
#include "stages/gel/press/drive/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include <numbers>

#include "common/base/error.h"
#include "common/sample/placement.h"
#include "tests/shared_data.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace simulate_test {

/// Forces of the gel's stresses on its vertices, tetrahedron by tetrahedron: P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ.
Positions elastic_forces(const TetMesh& gel, const Positions& x, const Material& material) {
  const auto edges = [](const Positions& at, const auto& tet) {
    Matrix3 D;
    for (int k = 0; k < 3; ++k) D.col(k) = at.row(tet[k + 1]) - at.row(tet[0]);
    return D;
  };
  Positions forces = Positions::Zero(x.rows(), 3);
  for (Eigen::Index t = 0; t < gel.tets.rows(); ++t) {
    const auto tet = gel.tets.row(t);
    const Matrix3 rest = edges(gel.positions, tet), F = edges(x, tet) * rest.inverse();
    const Matrix3 F_inverse_transposed = F.inverse().transpose();
    const Matrix3 stress = material.lame_mu_pa() * (F - F_inverse_transposed) +
                           material.lame_lambda_pa() * std::log(F.determinant()) * F_inverse_transposed;
    const Matrix3 on_corners = -rest.determinant() / 6.0 * stress * rest.inverse().transpose();
    for (int k = 0; k < 3; ++k) {
      forces.row(tet[k + 1]) += on_corners.col(k).transpose();
      forces.row(tet[0]) -= on_corners.col(k).transpose();
    }
  }
  return forces;
}

/// The smallest distance of gel and object over all pairs of their primitives.
double smallest_gap(const TetMesh& gel, const Positions& x, const TriangleMesh& object, const Matrix4& pose) {
  const ContactMesh mesh = make_contact_mesh(gel.positions, gel.boundary, {object});
  Positions all(mesh.num_vertices(), 3);
  all << x, transformed(pose, object.positions);
  double squared = std::numeric_limits<double>::infinity();
  const auto offer = [&](const ContactPair& pair) {
    squared = std::min(squared, closest_feature(pair, gather(all, pair)).squared_distance);
  };
  for (const int v : mesh.gel.vertices)
    for (const auto& t : mesh.object.triangles) offer(point_triangle_pair(v, t));
  for (const int v : mesh.object.vertices)
    for (const auto& t : mesh.gel.triangles) offer(point_triangle_pair(v, t));
  for (const auto& e : mesh.gel.edges)
    for (const auto& f : mesh.object.edges) offer(edge_edge_pair(e, f));
  return std::sqrt(squared);
}

/// Everything a frame says of its forces follows from its positions and those before, without the solver.
TEST(Simulate, SharpTipIntoCoarseGelIsWhereAndInWhatBalanceItSays) {
  const TetMesh gel = block_gel(8, 0.02, 0.002);
  const TriangleMesh object = pyramid(0.003, 0.002);
  const Sensor sensor = paper_sensor();
  PressConfig config = paper_config();
  config.linear_solver = LinearSolverKind::direct;
  const Simulation simulation = simulate(sensor, gel, object, config, press(0.5e-3, 5), "-z", ignore_progress);
  ASSERT_EQ(simulation.frames.size(), 6u);
  const double start_m = config.start_gap_d_hat * simulation.d_hat_m;
  EXPECT_NEAR(simulation.frames[0].min_gap_m.value(), start_m, 1e-12);
  EXPECT_EQ((simulation.frames[0].positions - gel.positions).norm(), 0.0);

  std::vector<bool> glued(static_cast<std::size_t>(gel.num_vertices()), false);
  for (const int v : gel.vertices(BoundaryTag::glued)) glued[v] = true;
  Eigen::VectorXd mass_kg = Eigen::VectorXd::Zero(gel.num_vertices());
  for (Eigen::Index t = 0; t < gel.tets.rows(); ++t) {
    Matrix3 D;
    for (int k = 0; k < 3; ++k) D.col(k) = gel.positions.row(gel.tets(t, k + 1)) - gel.positions.row(gel.tets(t, 0));
    for (int k = 0; k < 4; ++k) mass_kg[gel.tets(t, k)] += sensor.material.density_kg_m3 * D.determinant() / 24.0;
  }
  Positions velocity = Positions::Zero(gel.num_vertices(), 3);
  for (std::size_t f = 1; f < simulation.frames.size(); ++f) {
    const Frame& frame = simulation.frames[f];
    ASSERT_EQ(frame.solver.time_steps, 1);
    const Positions moved = transformed(frame.gel_from_object, object.positions);
    EXPECT_NEAR(moved.col(2).minCoeff(), start_m - static_cast<double>(f) / 5.0 * (start_m + 0.5e-3), 1e-15);
    EXPECT_NEAR(frame.min_gap_m.value(), smallest_gap(gel, frame.positions, object, frame.gel_from_object),
                1e-6 * *frame.min_gap_m);
    EXPECT_GT(*frame.min_gap_m, 0.0);
    EXPECT_GE(frame.stand_off_m, *frame.min_gap_m);
    EXPECT_LT(frame.stand_off_m, simulation.d_hat_m);

    const Positions before = velocity;
    velocity = (frame.positions - simulation.frames[f - 1].positions) / config.time_step_s;
    Positions force = elastic_forces(gel, frame.positions, sensor.material);
    force -= mass_kg.asDiagonal() * (velocity - before) / config.time_step_s;
    Vector3 pressed = Vector3::Zero(), torque = Vector3::Zero();
    for (std::size_t i = 0; i < simulation.front.vertices.size(); ++i) {
      const int v = simulation.front.vertices[i];
      const Vector3 pushed = frame.normal_force_n.row(static_cast<Eigen::Index>(i));
      force.row(v) += pushed.transpose();
      pressed += pushed;
      torque += Vector3(frame.positions.row(v)).cross(pushed);
    }
    EXPECT_LT((frame.force_n - pressed).norm(), 1e-12);
    EXPECT_LT((frame.torque_n_m - torque).norm(), 1e-14);
    // At each free vertex what is left is the solver's residual; at glued ones it is what the mount holds.
    double residual = 0.0;
    Vector3 held = Vector3::Zero(), left_over = Vector3::Zero();
    for (Eigen::Index v = 0; v < gel.num_vertices(); ++v) {
      if (glued[static_cast<std::size_t>(v)]) {
        held -= force.row(v).transpose();
      } else {
        residual += force.row(v).norm();
        left_over += force.row(v).transpose();
      }
    }
    EXPECT_NEAR(residual, frame.solver.force_residual_n, 1e-6 * residual + 1e-9);
    EXPECT_LT(residual, 1e-3 * pressed.norm() + 1e-5);
    EXPECT_LT((frame.balance.mount_n - held).norm(), 1e-9);
    EXPECT_NEAR(frame.balance.force_n, left_over.norm(), 1e-9);
    EXPECT_DOUBLE_EQ(frame.balance.relative, frame.balance.force_n / std::max(pressed.norm(), kSmallestContactN));
  }
}

TEST(Simulate, ForceDoesNotDependOnHowTheObjectIsTurned) {
  // The block and its subdivision are the same after half a turn about z, so the press must be, too.
  const TetMesh gel = block_gel(6, 0.02, 0.002);
  const TriangleMesh object = pyramid(0.003, 0.002);
  SampleSpec turned = press(0.3e-3, 2);
  turned.rotate_rad = std::numbers::pi;
  const double a = simulate(paper_sensor(), gel, object, paper_config(), press(0.3e-3, 2), "-z", ignore_progress)
                       .frames.back()
                       .force_n.z();
  const double b =
      simulate(paper_sensor(), gel, object, paper_config(), turned, "-z", ignore_progress).frames.back().force_n.z();
  EXPECT_NEAR(a, b, 1e-3 * std::abs(a));
}

PressConfig tight_config_with_friction() {
  PressConfig config = paper_config();
  config.relative_velocity_tolerance = 1e-5;
  config.friction = FrictionConfig{.coefficient = 0.5, .relative_speed_threshold = 1e-3, .max_lag_iterations = 1};
  return config;
}

Simulation press_pyramid(const PressConfig& config) {
  return simulate(paper_sensor(), block_gel(8, 0.02, 0.002), pyramid(0.003, 0.002), config, press(0.4e-3, 2), "-z",
                  ignore_progress);
}

TEST(Simulate, ConjugateGradientEndsWhereTheFactorisationDoes) {
  PressConfig config = tight_config_with_friction();
  const auto run = [&](LinearSolverKind solver) {
    config.linear_solver = solver;
    return press_pyramid(config);
  };
  const Simulation direct = run(LinearSolverKind::direct), iterative = run(LinearSolverKind::conjugate_gradient);
  EXPECT_EQ(iterative.times.factorised, 0);
  const Frame &a = direct.frames.back(), &b = iterative.frames.back();
  EXPECT_LT((a.positions - b.positions).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(a.force_n.z(), b.force_n.z(), 1e-4 * std::abs(a.force_n.z()));
}

TEST(Simulate, PositiveContactHessianEndsWhereTheAdaptiveOneDoesByAnotherRoute) {
  PressConfig config = tight_config_with_friction();
  std::vector<double> steps[2];  // lengths of all Newton steps
  const auto run = [&](bool adaptive) {
    config.newton.adaptive_contact_hessian = adaptive;
    return simulate(paper_sensor(), block_gel(8, 0.02, 0.002), pyramid(0.003, 0.002), config, press(0.4e-3, 2), "-z",
                    [&](int, int, int, double residual) { steps[adaptive].push_back(residual); });
  };
  const Simulation adaptive = run(true), positive = run(false);
  const Frame &a = adaptive.frames.back(), &b = positive.frames.back();
  double apart = 0.0;
  for (std::size_t i = 0; i < std::min(steps[0].size(), steps[1].size()); ++i)
    apart = std::max(apart, std::abs(steps[0][i] - steps[1][i]) / steps[0][i]);
  EXPECT_GT(apart, 0.1);
  EXPECT_LT((a.positions - b.positions).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_NEAR(a.force_n.z(), b.force_n.z(), 1e-4 * std::abs(a.force_n.z()));
}

/// At the end of a step only the vertices at the pyramid's edges still move.
void expect_patches_end_where_the_whole_does(const Sensor& sensor) {
  PressConfig config = paper_config();
  config.relative_velocity_tolerance = 2e-4;
  const auto run = [&](bool patches) {
    config.newton.patches = patches;
    return simulate(sensor, block_gel(24, 0.012, 0.002), pyramid(0.003, 0.002), config, press(0.4e-3, 4), "-z",
                    ignore_progress);
  };
  const Simulation with = run(true), without = run(false);
  const auto sum = [](const Simulation& all, auto number) {
    return std::accumulate(all.frames.begin(), all.frames.end(), 0,
                           [&](int so_far, const Frame& frame) { return so_far + frame.solver.*number; });
  };
  EXPECT_GT(sum(with, &StepReport::patches), 0);
  EXPECT_GT(sum(with, &StepReport::patch_iterations), 0);
  EXPECT_EQ(sum(without, &StepReport::patches), 0);
  EXPECT_LE(sum(with, &StepReport::newton_iterations), sum(without, &StepReport::newton_iterations));
  const Frame &a = with.frames.back(), &b = without.frames.back();
  EXPECT_LT((a.positions - b.positions).cwiseAbs().maxCoeff(), 2e-8);
  EXPECT_NEAR(a.force_n.z(), b.force_n.z(), 1e-3 * std::abs(a.force_n.z()));
}

TEST(Simulate, PatchesEndWhereTheWholeDoes) { expect_patches_end_where_the_whole_does(paper_sensor()); }

TEST(Simulate, PatchesOfAGelThatRelaxesEndWhereTheWholeDoes) {
  Sensor sensor = paper_sensor();
  sensor.material.relaxation = {{0.4, 0.02}};
  expect_patches_end_where_the_whole_does(sensor);
}

TEST(Simulate, ASoftBarrierGetsStifferWhereATipComesTooNear) {
  PressConfig config = paper_config();
  const Simulation stiff = press_pyramid(config);
  // All of the force is on one tip: the gap closes until no step can be certified, or until the barrier is stiffer.
  config.barrier_stiffness = 1e4;
  EXPECT_THROW(press_pyramid(config), SolverError);
  config.adaptive_barrier_stiffness = true;
  const Simulation adaptive = press_pyramid(config);
  const auto factor = [](const Simulation& s, std::size_t frame) { return s.frames[frame].solver.barrier_factor; };
  EXPECT_EQ(factor(stiff, 2), 1.0);
  EXPECT_GT(factor(adaptive, 1), 1.0);
  EXPECT_GE(factor(adaptive, 2), factor(adaptive, 1));
  // The tip stands off by less than a micrometre either way.
  const double force = stiff.frames[2].force_n.z();
  EXPECT_NEAR(adaptive.frames[2].force_n.z(), force, 0.02 * std::abs(force));
}

TEST(Simulate, NotConvergingIsAFailureWithItsNumbers) {
  PressConfig config = paper_config();
  config.newton.max_iterations = 2;
  try {
    simulate(paper_sensor(), block_gel(4, 0.02, 0.002), pyramid(0.003, 0.002), config, press(0.5e-3, 1), "-z",
             ignore_progress);
    FAIL() << "a capped Newton passed for a result";
  } catch (const SolverError& error) {
    EXPECT_NE(std::string(error.what()).find("frame 1: Newton did not converge within 2 iterations"), std::string::npos)
        << error.what();
  }
}

TEST(Simulate, DepthBeyondTheGelIsRefused) {
  try {
    simulate(paper_sensor(), block_gel(4, 0.02, 0.002), pyramid(0.003, 0.002), paper_config(), press(2e-3, 5), "-z",
             ignore_progress);
    FAIL() << "accepted";
  } catch (const DataError& error) {
    EXPECT_STREQ(error.what(), "depth 2 mm is not less than the gel's thickness 2 mm");
  }
}

/// The smaller of the two scenes of docs/paper.md.
TEST(Simulate, AgreesWithTheReferenceSolver) {
  TACIPC_SHARED_DATA(folder, "reference");
  const ReferenceComparison found = compare_with_reference(folder, "gel3k.msh", "sphere1k.obj", "sphere_small_press");
  EXPECT_NEAR(found.press_force_n.back(), 0.4201, 0.002 * 0.4201);
  EXPECT_LT(found.rms_m, 0.2e-6);
  EXPECT_LT(found.largest_m, 3e-6);
}

TEST(Simulate, ShearAgreesWithTheReferenceSolver) {
  TACIPC_SHARED_DATA(folder, "reference");
  const ReferenceComparison found =
      compare_with_reference(folder, "gel3k.msh", "sphere1k.obj", "sphere_small_shear", true);
  // Friction lagged at the start of each step instead of where that solver does would be 5 and 7 % off after the shear.
  EXPECT_NEAR(found.press_force_n[4], 0.4534, 0.003 * 0.4534);
  EXPECT_NEAR(found.press_force_n[9], 0.4216, 0.003 * 0.4216);
  EXPECT_NEAR(found.tangential_force_n[9], 0.2374, 0.003 * 0.2374);
  EXPECT_LT(found.front_rms_m, 0.5e-6);
  EXPECT_LT(found.front_99_m, 2e-6);
  EXPECT_LT(found.front_largest_m, 5e-6);
}

std::string refusal(const TriangleMesh& object, bool once) {
  PressConfig config = paper_config();
  config.pair_counting.once = once;
  try {
    simulate(paper_sensor(), block_gel(4, 0.02, 0.002), object, config, press(0.1e-3, 1), "-z", ignore_progress);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(Simulate, CountingPairsOnceNeedsAClosedObjectThatLooksOutwards) {
  const TriangleMesh closed = pyramid(0.003, 0.002);
  TriangleMesh open = closed, inwards = closed;
  open.triangles = Triangles(closed.triangles.topRows(5));
  inwards.triangles.col(0).swap(inwards.triangles.col(1));
  EXPECT_EQ(refusal(closed, true), "");
  EXPECT_THAT(refusal(open, true), ::testing::HasSubstr("the object is not closed: the edge of its vertices "));
  EXPECT_THAT(refusal(inwards, true), ::testing::HasSubstr("faces look inwards"));
  EXPECT_EQ(refusal(open, false), "");
  EXPECT_EQ(refusal(inwards, false), "");
}

}  // namespace simulate_test
}  // namespace tacipc
