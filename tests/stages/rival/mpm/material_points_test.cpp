// The scheme against what physics says: rest, momentum, stress, waves; and the same bits with any number of threads.
#include "stages/rival/mpm/material_points.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "tests/scratch_folder.h"
#include "tests/stages/rival/mpm/kirchhoff_stress.h"
#include "tests/stages/rival/mpm/particle_state.h"

namespace tacipc {
namespace material_points_test {

constexpr double kCell = 0.2e-3;

MpmSetup soft(double courant = 0.3) {
  MpmSetup setup{.grid_spacing_m = kCell,
                 .mu_pa = 4e4,
                 .lambda_pa = 8e4,
                 .density_kg_m3 = 1000.0,
                 .particle_volume_m3 = std::pow(kCell / 2.0, 3)};
  setup.step_s = courant * kCell / setup.wave_speed_m_s();
  return setup;
}

/// nx × ny × nz particles, eight in a cell, the lowest corner at (0, 0, 0).
Positions block(int nx, int ny, int nz) {
  Positions rest(static_cast<Eigen::Index>(nx) * ny * nz, 3);
  Eigen::Index row = 0;
  for (int k = 0; k < nz; ++k)
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < ny; ++j) rest.row(row++) = 0.5 * kCell * Eigen::RowVector3d(i + 0.5, j + 0.5, k + 0.5);
  return rest;
}

/// A block that tumbles, stretched and sheared differently in every particle.
MaterialPoints tumbling(int side) {
  const Positions rest = block(side, side + 3, side);
  MaterialPoints points(rest, soft());
  std::vector<ParticleState> states = states_of(points);
  for (std::size_t p = 0; p < states.size(); ++p) {
    const auto random = [&](std::uint64_t k) { return random_uniform(3, k, p) - 0.5; };
    states[p].velocity_m_s = Vector3(0.3 + 0.4 * random(0), 0.4 * random(1), -0.2 + 0.4 * random(2));
    for (int k = 0; k < 9; ++k) states[p].deformation(k / 3, k % 3) += 0.1 * random(static_cast<std::uint64_t>(3 + k));
  }
  set_states(points, states);
  return points;
}

TEST(MaterialPoints, AtRestStayAtRest) {
  MpmSetup setup = soft();
  setup.held_below_m = 0.0;
  MaterialPoints points(block(12, 12, 8), setup);
  // Far above, out of reach, and moving.
  points.place_object(Positions{{1e-3, 1e-3, 5e-3}}, Matrix4::Identity());
  Matrix4 pose = Matrix4::Identity();
  for (int step = 0; step < 200; ++step) {
    pose(0, 3) += 1e-6;
    points.step(pose);
  }
  EXPECT_EQ(points.kinetic_energy_j(), 0.0);
  EXPECT_EQ(points.shifts_m(0, points.num_particles()).cwiseAbs().maxCoeff(), 0.0);
}

TEST(MaterialPoints, ABodyThatNothingHoldsFliesOnUndeformed) {
  MaterialPoints points(block(10, 10, 6), soft());
  std::vector<ParticleState> states = states_of(points);
  const Vector3 v(0.8, -0.5, 0.3);
  for (ParticleState& state : states) state.velocity_m_s = v;
  set_states(points, states);
  constexpr int kSteps = 400;
  for (int step = 0; step < kSteps; ++step) points.step();
  const Vector3 way = kSteps * soft().step_s * v;
  EXPECT_GT(way.norm(), 9.0 * kCell) << "through many cells and tiles";
  EXPECT_GT(points.num_sorts(), 3);
  for (const ParticleState& state : states_of(points)) {
    EXPECT_LT((state.shift_m - way).norm(), 1e-4 * way.norm());
    EXPECT_LT((state.deformation - Matrix3::Identity()).norm(), 1e-4);
  }
}

/// Σ x × m v of tumbling(side) about the origin, kg m²/s. Within a particle velocity varies as C (x − x_p), and the
/// B-spline's second moment is a quarter of a cell squared.
Vector3 spin_of(const MaterialPoints& points, int side) {
  const Positions rest = block(side, side + 3, side);
  Vector3 sum = Vector3::Zero();
  Eigen::Index p = 0;
  for (const ParticleState& state : states_of(points)) {
    const Vector3 x = rest.row(p++).transpose() + state.shift_m;
    const Matrix3& C = state.velocity_gradient_per_s;
    sum += x.cross(state.velocity_m_s) +
           0.25 * kCell * kCell * Vector3(C(2, 1) - C(1, 2), C(0, 2) - C(2, 0), C(1, 0) - C(0, 1));
  }
  return soft().particle_mass_kg() * sum;
}

TEST(MaterialPoints, KeepTheirMomentumAndTheirSpin) {
  MaterialPoints points = tumbling(10);
  points.step();  // what single particles' random velocities hold beyond what nodes can is gone now
  const Vector3 momentum = points.momentum(), spin = spin_of(points, 10);
  const double mass = soft().particle_mass_kg() * points.num_particles();
  for (int step = 0; step < 300; ++step) points.step();
  EXPECT_LT((points.momentum() - momentum).norm(), 1e-5 * momentum.norm());
  EXPECT_GT(spin.norm(), 0.0);
  EXPECT_LT((spin_of(points, 10) - spin).norm(), 1e-5 * mass * 0.3 * 1e-3);
  EXPECT_GT(points.kinetic_energy_j(), 0.5 * momentum.squaredNorm() / mass);
}

TEST(MaterialPoints, SpinOfScatteredVelocitiesIsKeptFromTheFirstStepOn) {
  MaterialPoints points = tumbling(8);
  const Vector3 momentum = points.momentum(), spin = spin_of(points, 8);
  points.step();
  EXPECT_LT((points.momentum() - momentum).norm(), 1e-6 * momentum.norm());
  EXPECT_LT((spin_of(points, 8) - spin).norm(), 1e-5 * spin.norm());
}

TEST(MaterialPoints, OneParticleIsPushedApartByItsStress) {
  // Alone on the grid it gets back, as velocity gradient, what its stress gave to the nodes: −4 Δt τ / (ρ Δx²).
  const MpmSetup setup = soft();
  for (const Vector3& place : {Vector3(0, 0, 0), Vector3(0.31, 0.77, 0.5)}) {
    MaterialPoints points(kCell * place.transpose(), setup);
    std::vector<ParticleState> states = states_of(points);
    states[0].deformation << 1.1, 0.05, 0.0, -0.1, 0.9, 0.02, 0.03, 0.0, 1.2;
    states[0].velocity_m_s = {0.1, 0.2, -0.1};
    set_states(points, states);
    points.step();
    const Matrix3 tau = kirchhoff_stress(states[0].deformation, setup.mu_pa, setup.lambda_pa);
    const Matrix3 expected = -4.0 * setup.step_s / (setup.density_kg_m3 * kCell * kCell) * tau;
    const ParticleState after = states_of(points)[0];
    EXPECT_LT((after.velocity_gradient_per_s - expected).norm(), 2e-6 * expected.norm());
    EXPECT_LT((after.velocity_m_s - states[0].velocity_m_s).norm(), 1e-6);
    EXPECT_LT((after.deformation - (Matrix3::Identity() + setup.step_s * expected) * states[0].deformation).norm(),
              1e-6);
  }
}

/// Half a period of a bar that is held below and swings along itself, over that of the continuum, 2 L / √(E / ρ).
double relative_half_period(int cells) {
  MpmSetup setup = soft(0.25);
  setup.lambda_pa = 0.0;  // Poisson's ratio 0: E = 2 μ, and the sides stay where they are
  setup.held_below_m = 0.0;
  const double length = cells * kCell, wave = std::sqrt(2.0 * setup.mu_pa / setup.density_kg_m3);
  setup.step_s = 0.25 * kCell / wave;
  const int side = 4, layers = 2 * cells;
  const Positions rest = block(side, side, layers);
  MaterialPoints points(rest, setup);
  std::vector<ParticleState> states = states_of(points);
  for (std::size_t p = 0; p < states.size(); ++p)
    states[p].velocity_m_s.z() =
        1e-3 * wave * std::sin(0.5 * std::numbers::pi * rest(static_cast<Eigen::Index>(p), 2) / length);
  set_states(points, states);
  const int top = side * side;
  double before = 0.0;
  for (int step = 1; step < 40 * cells; ++step) {
    points.step();
    const double now = points.shifts_m(top * (layers - 1), top).col(2).mean();
    if (before > 0.0 && now <= 0.0) return (step - now / (now - before)) * setup.step_s / (2.0 * length / wave);
    before = now;
  }
  return NAN;
}

TEST(MaterialPoints, FrequencyOfABarConverges) {
  const double coarse = relative_half_period(4) - 1.0, middle = relative_half_period(8) - 1.0,
               fine = relative_half_period(16) - 1.0;
  RecordProperty("relative_error_4_8_16", fmt::format("{:.4f} {:.4f} {:.4f}", coarse, middle, fine));
  EXPECT_LT(std::abs(fine), 0.02) << coarse << " " << middle << " " << fine;
  EXPECT_GT(std::log2(std::abs(coarse / middle)), 0.8) << coarse << " " << middle << " " << fine;
  EXPECT_GT(std::log2(std::abs(middle / fine)), 0.8) << coarse << " " << middle << " " << fine;
}

TEST(MaterialPoints, FixedParticlesAndHeldNodesDoNotMove) {
  for (const bool nodes : {false, true}) {
    MpmSetup setup = soft();
    if (nodes)
      setup.held_below_m = 0.0;
    else
      setup.num_fixed = 10 * 10;
    MaterialPoints points(block(10, 10, 6), setup);
    std::vector<ParticleState> states = states_of(points);
    for (ParticleState& state : states) state.velocity_m_s = {0.2, 0.0, 0.0};
    set_states(points, states);
    for (int step = 0; step < 300; ++step) points.step();
    const double lowest = points.shifts_m(0, 100).cwiseAbs().maxCoeff(),
                 highest = points.shifts_m(500, 100).cwiseAbs().maxCoeff();
    EXPECT_GT(highest, 0.03 * kCell);
    if (!nodes) {
      EXPECT_EQ(lowest, 0.0);
    }
    EXPECT_LT(lowest, 0.3 * highest);
  }
}

TEST(MaterialPoints, DampingTakesVelocityAway) {
  MpmSetup setup = soft();
  setup.damping_per_s = 0.01 / setup.step_s;
  MaterialPoints points(block(6, 6, 6), setup);
  std::vector<ParticleState> states = states_of(points);
  for (ParticleState& state : states) state.velocity_m_s = {0.1, 0.0, 0.0};
  set_states(points, states);
  for (int step = 0; step < 100; ++step) points.step();
  EXPECT_NEAR(states_of(points)[0].velocity_m_s.x(), 0.1 * std::pow(0.99, 100), 1e-6);
}

/// A heavy plate that comes down on a held block and turns.
std::vector<ParticleState> pressed(int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  MpmSetup setup = soft();
  setup.held_below_m = 0.0;
  setup.object_mass_ratio = 20.0;
  MaterialPoints points(block(60, 44, 8), setup);
  Positions plate(900, 3);
  for (int i = 0; i < 900; ++i) plate.row(i) << 0.1e-3 * (i / 30) - 1.5e-3, 0.1e-3 * (i % 30) - 1.5e-3, 0.0;
  Matrix4 pose = Matrix4::Identity();
  pose.topRightCorner<3, 1>() << 3e-3, 2.2e-3, 1.2e-3;
  points.place_object(plate, pose);
  for (int step = 0; step < 150; ++step) {
    pose(2, 3) -= 4e-6;
    pose.topLeftCorner<3, 3>() =
        Eigen::AngleAxisd(0.002, Vector3::UnitZ()).toRotationMatrix() * pose.topLeftCorner<3, 3>();
    points.step(pose);
  }
  EXPECT_GT(points.num_sorts(), 2);
  return states_of(points);
}

TEST(MaterialPoints, SameBitsWithAnyNumberOfThreads) {
  const std::vector<ParticleState> one = pressed(1);
  double deepest = 0.0;
  for (const ParticleState& state : one) deepest = std::min(deepest, state.shift_m.z());
  EXPECT_LT(deepest, -0.2e-3) << "the plate has reached the block";
  for (const int threads : {2, 3, 5}) {
    const std::vector<ParticleState> other = pressed(threads);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t p = 0; p < one.size(); ++p) {
      ASSERT_EQ(one[p].shift_m, other[p].shift_m) << "particle " << p << ", threads " << threads;
      ASSERT_EQ(one[p].velocity_m_s, other[p].velocity_m_s);
      ASSERT_EQ(one[p].velocity_gradient_per_s, other[p].velocity_gradient_per_s);
      ASSERT_EQ(one[p].deformation, other[p].deformation);
    }
  }
}

TEST(MaterialPoints, TheObjectGivesItsVelocityToWhatItTouches) {
  MpmSetup setup = soft();
  setup.object_mass_ratio = 1e4;
  MaterialPoints points(block(12, 12, 4), setup);
  Positions plate(400, 3);
  for (int i = 0; i < 400; ++i) plate.row(i) << 0.06e-3 * (i / 20), 0.06e-3 * (i % 20), 0.4e-3;
  points.place_object(plate, Matrix4::Identity());
  Matrix4 pose = Matrix4::Identity();
  pose(0, 3) = 1e-6;
  points.step(pose);
  // The top particle in the middle sees nodes of the plate's velocity alone.
  const ParticleState top = states_of(points)[3 * 144 + 6 * 12 + 6];
  EXPECT_NEAR(top.velocity_m_s.x(), 1e-6 / setup.step_s, 0.01 * 1e-6 / setup.step_s);
  EXPECT_NEAR(top.velocity_m_s.z(), 0.0, 1e-6);
}

TEST(MaterialPoints, AStepThatIsTooLongIsRefused) {
  MaterialPoints points(block(6, 6, 6), soft(3.0));
  std::vector<ParticleState> states = states_of(points);
  for (ParticleState& state : states) state.deformation *= 1.2;
  set_states(points, states);
  const std::string message = message_of<SolverError>([&] {
    for (int step = 0; step < 50; ++step) points.step();
  });
  EXPECT_NE(message.find("too long for this grid and material"), std::string::npos) << message;
}

TEST(MaterialPoints, AnObjectThatJumpsIsRefused) {
  MaterialPoints points(block(6, 6, 6), soft());
  points.place_object(Positions{{0, 0, 1e-3}}, Matrix4::Identity());
  Matrix4 pose = Matrix4::Identity();
  pose(1, 3) = kCell;
  EXPECT_EQ(message_of<SolverError>([&] { points.step(pose); }),
            "the object moves 1 cells of the grid in one step (at most 0.5)");
}

}  // namespace material_points_test
}  // namespace tacipc
