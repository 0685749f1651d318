// Scenes of a few small bodies, against statics.
#include "stages/gel/press/drive/scene.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/sample/placement.h"
#include "stages/gel/press/energy/elasticity.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/press/cut_box.h"
#include "tests/stages/gel/press/drive/grasp_scene.h"

namespace tacipc {
namespace scene_test {

using ::testing::HasSubstr;

constexpr double kBoxMass_kg = 0.02, kThickness_m = 0.002;
const Vector3 kHalf(3e-3, 3e-3, 3e-3);

Matrix4 at(const Vector3& place, const Vector3& turn_rad = Vector3::Zero()) {
  Matrix4 pose = Matrix4::Identity();
  pose.topRightCorner<3, 1>() = place;
  if (turn_rad != Vector3::Zero())
    pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).toRotationMatrix();
  return pose;
}

/// Bodies and what the file says of them, gels first.
class SceneOf : public ::testing::Test {
 protected:
  void add_gel(const std::string& name, const Matrix4& pose) {
    spec_.bodies.push_back({.name = name, .kind = BodyKind::gel, .world_from_body = pose});
    bodies_.push_back({.tets = block_gel(6, 0.02, kThickness_m), .material = paper_sensor().material});
  }
  void add_box(const std::string& name, BodyKind kind, const Vector3& place, const Vector3& half = kHalf) {
    BodySpec body{.name = name, .kind = kind, .world_from_body = at(place)};
    if (kind == BodyKind::rigid) body.mass.mass_kg = kBoxMass_kg;
    spec_.bodies.push_back(body);
    bodies_.push_back({.surface = centered_box(half)});
  }
  Scene run(FrameStore* store = nullptr) {
    return run_scene(paper_sensor(), bodies_, config_, spec_, ignore_progress, store);
  }
  const Wrench& on(const SceneFrame& frame, std::size_t a, std::size_t b) const {
    return frame.between[a * bodies_.size() + b];
  }

  PressConfig config_ = grasp_config(0.5);
  SceneSpec spec_;
  std::vector<SceneBody> bodies_;
};

TEST_F(SceneOf, AGelOnAPathGoesAsOneThatIsMoved) {
  const auto press = [&](bool by_path) {
    spec_.bodies.clear(), bodies_.clear();
    add_gel("gel", at(Vector3::Zero()));
    add_box("above", BodyKind::fixed, {0, 0, 3.1e-3});
    spec_.motion = {{.steps = 4}};
    const RigidWay way{.shift_m = {0.1e-3, 0, 0.3e-3}, .turn_rad = {0, 0, 0.02}};
    if (by_path) {
      for (int k = 0; k <= 4; ++k) bodies_[0].path.push_back(moved(Matrix4::Identity(), way * (k / 4.0)));
    } else {
      spec_.motion[0].move = {{.body = 0, .way = way}};
    }
    return run();
  };
  const Scene moved = press(false), along = press(true);
  EXPECT_EQ(along.frames[4].world_from_body[0], bodies_[0].path[4]);
  EXPECT_GT(-along.gels[0].frames[4].force_n.z(), 1.0);
  EXPECT_LT((along.gels[0].frames[4].force_n - moved.gels[0].frames[4].force_n).norm(), 1e-6);
  EXPECT_LT((along.gels[0].frames[4].positions - moved.gels[0].frames[4].positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(SceneOf, FramesOfAnotherPathOrTimeStepAreRefused) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("above", BodyKind::fixed, {0, 0, 3.1e-3});
  const auto rise_by = [&](double way_m, int steps) {
    bodies_[0].path.clear();
    for (int k = 0; k <= steps; ++k) bodies_[0].path.push_back(at({0, 0, way_m * k}));
    spec_.motion = {{.steps = steps}};
  };
  rise_by(1e-5, 2);
  MemoryStore first;
  run(&first);
  rise_by(1e-5, 3);
  MemoryStore same(first.saved);
  EXPECT_EQ(run(&same).frames.size(), 4u);
  rise_by(2e-4, 3);
  MemoryStore other(first.saved);
  EXPECT_THAT(message_of<DataError>([&] { run(&other); }),
              HasSubstr("frame 1: body gel was solved 0.19 mm from where its path has it"));
  spec_.time_step_s = 0.5 * config_.time_step_s;
  EXPECT_THAT(message_of<UsageError>([&] { run(); }), HasSubstr("time_step_s: the paths of the scene are made for"));
}

TEST_F(SceneOf, APathHasAPoseForEachTimeStep) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("above", BodyKind::fixed, {0, 0, 3.1e-3});
  spec_.motion = {{.steps = 3, .substeps = 2}};
  bodies_[0].path.assign(5, Matrix4::Identity());
  const auto said = [&] { return message_of<DataError>([&] { run(); }); };
  EXPECT_THAT(said(), HasSubstr("body gel: its path has 5 poses; 6 time steps need 7"));
  bodies_[0].path.assign(7, Matrix4::Identity());
  bodies_[0].path[6] = at(Vector3::Zero(), {0, 0.3, 0});
  EXPECT_THAT(said(), HasSubstr("body gel: its path turns by 0.3 rad in time step 6"));
}

TEST_F(SceneOf, ABoxOnAGelCarriesAnotherThatOnlyThenIsLetGo) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("lower", BodyKind::rigid, {0, 0, 3.1e-3});
  add_box("upper", BodyKind::rigid, {1e-3, 0, 9.2e-3});
  spec_.motion = {{.steps = 20, .hold = {2}}, {.steps = 60}, {.steps = 20, .load_n = {{2, {0, 0, -0.3}}}}};
  const Scene scene = run();
  const double weight = kBoxMass_kg * kG;
  ASSERT_EQ(scene.frames.size(), 101u);
  ASSERT_EQ(scene.gels.size(), 1u);
  EXPECT_EQ(scene.mass_kg, (std::vector{kBoxMass_kg, kBoxMass_kg}));
  EXPECT_EQ(scene.frames[20].world_from_body[2], spec_.bodies[2].world_from_body);
  EXPECT_NEAR(-scene.gels[0].frames[20].force_n.z(), weight, 2e-2 * weight);
  const SceneFrame &rest = scene.frames[80], &loaded = scene.frames[100];
  EXPECT_NEAR(on(rest, 2, 1).force_n.z(), weight, 1e-2 * weight);
  EXPECT_NEAR(on(rest, 1, 0).force_n.z(), 2.0 * weight, 1e-2 * weight);
  EXPECT_NEAR(on(loaded, 2, 1).force_n.z(), weight + 0.3, 1e-2 * weight);
  EXPECT_NEAR(on(loaded, 1, 0).force_n.z(), 2.0 * weight + 0.3, 1e-2 * weight);
  // What the gel's own record says is what the wrench on it says.
  EXPECT_LT((scene.gels[0].frames[100].force_n - on(loaded, 0, 1).force_n).norm(), 1e-9);
  EXPECT_LT((scene.gels[0].frames[100].torque_n_m - on(loaded, 0, 1).torque_n_m).norm(), 1e-9);
  // They lie still where they are: on each other.
  EXPECT_LT(loaded.velocity_m_s[1].norm(), 2e-3);
  EXPECT_NEAR(loaded.world_from_body[2](2, 3) - loaded.world_from_body[1](2, 3), 2.0 * kHalf.z(), 1e-4);
}

/// Without friction anything that pushes sideways is never stopped. The table's diagonals lie under the corners of what
/// stands on it, or a little beside, and vertices of its grid under a rim.
TEST_F(SceneOf, WithoutFrictionBodiesAtRestStayAtRest) {
  constexpr double kLight_kg = 1e-3;
  const double gap_m = 1.2 * config_.relative_d_hat * 28.4e-3;  // in frame 0: more than d̂ of the gel's diagonal
  const auto stand = [&](const TriangleMesh& table, const TriangleMesh& body, const Vector3& aside_m) {
    spec_.bodies.clear(), bodies_.clear();
    add_gel("gel", at({0, 0, -0.1}));
    const double top_m = table.positions.col(2).maxCoeff(), low_m = body.positions.col(2).minCoeff();
    spec_.bodies.push_back({.name = "table", .kind = BodyKind::fixed});
    bodies_.push_back({.surface = table});
    add_box("body", BodyKind::rigid, aside_m + Vector3(0, 0, top_m - low_m + gap_m));
    bodies_.back().surface = body;
    spec_.bodies.back().mass.mass_kg = kLight_kg;
    std::swap(spec_.bodies[1], spec_.bodies[2]), std::swap(bodies_[1], bodies_[2]);  // rigid before fixed
    spec_.contact = {{.between = {1, 2}, .friction = 0.0}};
    spec_.motion = {{.steps = 12}};
    const Scene scene = run();
    const Matrix4 moved = scene.frames.back().world_from_body[1] - scene.frames.front().world_from_body[1];
    const Vector3 shift = moved.topRightCorner<3, 1>();
    const Matrix3 turn = moved.topLeftCorner<3, 3>();
    EXPECT_NEAR(on(scene.frames.back(), 1, 2).force_n.z(), kLight_kg * kG, 1e-2 * kLight_kg * kG);
    EXPECT_LT(shift.head<2>().norm(), 2e-8);
    EXPECT_LT(turn.norm(), 1e-4);
    EXPECT_LT(scene.frames.back().velocity_m_s[0].head<2>().norm(), 1e-6);
    EXPECT_LT(std::abs(scene.frames.back().spin_rad_s[0].z()), 1e-4);
  };
  const Vector3 table(30e-3, 30e-3, 5e-3), plate(10e-3, 10e-3, 1e-3), box(5e-3, 5e-3, 5e-3);
  stand(cut_box(table, Cut::diagonal), cut_box(plate, Cut::fan), {0, 0, 0});
  stand(cut_box(table, Cut::diagonal), cut_box(box, Cut::diagonal), {0, 0, 0});
  stand(cut_box(table, Cut::grid, 6), cut_box(plate, Cut::grid, 4), {0, 0, 0});
  stand(cut_box(table, Cut::fan), cut_box(plate, Cut::fan), {0.3e-3, 0.1e-3, 0});
  stand(cut_box(table, Cut::other_diagonal), cut_box(box, Cut::grid, 4), {3e-6, 0, 0});
}

TEST_F(SceneOf, TwoGelsPressOnEachOtherAsEachSeesItInItsOwnFrame) {
  add_gel("below", at(Vector3::Zero()));
  add_gel("above", at({0, 0, 0.5e-3}, {std::numbers::pi, 0, 0}));
  spec_.gravity_m_s2.setZero();
  spec_.motion = {{.steps = 3, .move = {{.body = 1, .way = {.shift_m = {0, 0, -0.6e-3}}}}}};
  config_.friction.reset();
  const Scene scene = run();
  const Frame &below = scene.gels[0].frames.back(), &above = scene.gels[1].frames.back();
  EXPECT_GT(-below.force_n.z(), 0.1);
  EXPECT_NEAR(below.force_n.z(), above.force_n.z(), 1e-3 * -below.force_n.z());
  // Both fronts are pressed in by about half of 0.1 mm.
  const auto front_height = [](const Frame& frame) {
    double sum = 0.0;
    int count = 0;
    for (Eigen::Index v = 0; v < frame.positions.rows(); ++v) {
      if (frame.positions(v, 2) < -0.5 * kThickness_m || frame.positions.row(v).head<2>().norm() > 4e-3) continue;
      sum += frame.positions(v, 2);
      ++count;
    }
    return sum / count;
  };
  EXPECT_NEAR(front_height(below), front_height(above), 2e-5);
  EXPECT_LT(front_height(below), -0.04e-3);
}

TEST_F(SceneOf, AMountTakesItsGelAlongAndTurnsIt) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("far", BodyKind::fixed, {0, 0, 0.05});
  spec_.gravity_m_s2.setZero();
  spec_.motion = {{.steps = 10, .move = {{.body = 0, .way = {{5e-3, 0, 1e-3}, {0, 0, 1.0}}}}}, {.steps = 30}};
  const Scene scene = run();
  const SceneFrame& end = scene.frames.back();
  EXPECT_LT((end.world_from_body[0] - at({5e-3, 0, 1e-3}, {0, 0, 1.0})).cwiseAbs().maxCoeff(), 1e-15);
  // At rest again, in its own frame it is as it was.
  EXPECT_LT((scene.gels[0].frames.back().positions - bodies_[0].tets.positions).cwiseAbs().maxCoeff(), 2e-5);
}

TEST_F(SceneOf, TwoGelsLiftABoxFromATable) {
  // The gels' fronts face each other along x; the table is below.
  const Vector3 about_y(0, 0.5 * std::numbers::pi, 0);
  add_gel("left", at({-3.2e-3, 0, 0}, about_y));
  add_gel("right", at({3.2e-3, 0, 0}, -about_y));
  add_box("box", BodyKind::rigid, {0, 0, 0});
  add_box("table", BodyKind::fixed, {0, 0, -13.05e-3}, {0.02, 2.5e-3, 0.01});
  // The gels reach below the box: the table is a narrow one beside them.
  bodies_[3].surface = centered_box({2.5e-3, 2.5e-3, 0.01});
  config_.friction->coefficient = 0.9;
  spec_.motion = {
      {.steps = 8, .hold = {2}},
      {.steps = 10,
       .move = {{.body = 0, .way = {.shift_m = {0.5e-3, 0, 0}}}, {.body = 1, .way = {.shift_m = {-0.5e-3, 0, 0}}}}},
      {.steps = 20,
       .move = {{.body = 0, .way = {.shift_m = {0, 0, 3e-3}}, .smooth = true},
                {.body = 1, .way = {.shift_m = {0, 0, 3e-3}}, .smooth = true}}},
      {.steps = 20}};
  const Scene scene = run();
  const double weight = kBoxMass_kg * kG;
  const SceneFrame& end = scene.frames.back();
  EXPECT_NEAR(end.world_from_body[2](2, 3), 3e-3, 0.2e-3);
  EXPECT_EQ(on(end, 2, 3).force_n.norm(), 0.0);
  EXPECT_NEAR(on(end, 2, 0).force_n.z() + on(end, 2, 1).force_n.z(), weight, 1e-2 * weight);
}

TEST_F(SceneOf, TouchesGelsWithTheFrictionOfTheirSensor) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("box", BodyKind::rigid, {0, 0, 3.1e-3});
  add_box("floor", BodyKind::fixed, {13.1e-3, 0, 0});
  spec_.motion = {{.steps = 3}, {.steps = 3, .load_n = {{1, {0.15, 0, 0}}}}};
  config_.friction->coefficient = 0.2;
  Sensor sensor = paper_sensor();
  sensor.friction = 0.9;
  const auto end = [&](const Sensor& of) {
    return run_scene(of, bodies_, config_, spec_, ignore_progress).frames.back().world_from_body[1];
  };
  const Matrix4 of_sensor = end(sensor), of_file = end(paper_sensor());
  spec_.contact = {{.between = {0, 1}, .friction = 0.9}};
  EXPECT_EQ(end(paper_sensor()), of_sensor);
  EXPECT_GT(of_file(0, 3), of_sensor(0, 3) + 0.1e-3);
  // What a pair says of itself counts.
  spec_.contact = {{.between = {0, 1}, .friction = 0.2}};
  EXPECT_LT((end(sensor) - of_file).cwiseAbs().maxCoeff(), 0.03e-3);
}

TEST_F(SceneOf, ResumesToTheSameBitsWithAnyNumberOfThreads) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("box", BodyKind::rigid, {0, 0, 3.1e-3});
  add_box("wall", BodyKind::fixed, {7e-3, 0, 5e-3});
  spec_.motion = {{.steps = 4}, {.steps = 4, .load_n = {{1, {0.1, 0, 0}}}}};
  MemoryStore whole;
  const Scene once = run(&whole);
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
  for (const std::size_t known : {1u, 6u}) {
    MemoryStore part(std::vector<std::string>(whole.saved.begin(), whole.saved.begin() + static_cast<long>(known)));
    const Scene again = run(&part);
    EXPECT_EQ(part.saved, whole.saved) << known;
    EXPECT_EQ(again.frames.back().world_from_body, once.frames.back().world_from_body);
  }
}

TEST_F(SceneOf, WhatItCannotBeIsSaidBeforeItStarts) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("box", BodyKind::rigid, {0, 0, 3.1e-3});
  spec_.motion = {{.steps = 1}};
  const auto message = [&] {
    try {
      run();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  spec_.contact = {{.between = {0, 1}, .d_hat_m = 1.0}};
  EXPECT_THAT(message(), HasSubstr("d_hat_mm is more than that of the gels"));
  spec_.contact = {{.between = {0, 1}, .friction = 0.5}};
  config_.friction.reset();
  EXPECT_THAT(message(), HasSubstr("no section friction"));
  spec_.contact.clear();
  spec_.bodies[1].world_from_body = at({0, 0, 2.9e-3});
  EXPECT_THAT(message(), HasSubstr("bodies gel and box intersect where they begin"));
  bodies_[1].surface.triangles.conservativeResize(11, 3);
  EXPECT_THAT(message(), HasSubstr("not closed"));
}

TEST_F(SceneOf, ASoftBallOfAnotherMaterialIsHeldByTwoGels) {
  const Vector3 about_y(0, 0.5 * std::numbers::pi, 0);
  add_gel("left", at({-3.2e-3, 0, 0}, about_y));
  add_gel("right", at({3.2e-3, 0, 0}, -about_y));
  // A block without a mount, softer than the gels.
  TetMesh block = block_gel(3, 6e-3, 6e-3);
  std::fill(block.tags.begin(), block.tags.end(), BoundaryTag::free);
  Material soft = paper_sensor().material;
  soft.youngs_modulus_pa *= 0.5;
  spec_.bodies.push_back({.name = "block", .kind = BodyKind::soft, .world_from_body = at({0, 0, 3e-3})});
  bodies_.push_back({.tets = block, .material = soft});
  config_.friction->coefficient = 0.9;
  spec_.gravity_m_s2.setZero();
  spec_.motion = {
      {.steps = 10,
       .move = {{.body = 0, .way = {.shift_m = {0.4e-3, 0, 0}}}, {.body = 1, .way = {.shift_m = {-0.4e-3, 0, 0}}}}},
      {.steps = 10,
       .move = {{.body = 0, .way = {.shift_m = {0, 0, 2e-3}}}, {.body = 1, .way = {.shift_m = {0, 0, 2e-3}}}}},
      {.steps = 10}};
  const Scene scene = run();
  const SceneFrame &gripped = scene.frames[10], &end = scene.frames.back();
  const double grip = on(gripped, 0, 2).force_n.norm();
  EXPECT_GT(grip, 0.05);
  EXPECT_NEAR(on(gripped, 1, 2).force_n.x(), -on(gripped, 0, 2).force_n.x(), 0.02 * grip);
  // It goes along with the gels.
  const double rose = end.soft_m[0].col(2).mean() - gripped.soft_m[0].col(2).mean();
  EXPECT_NEAR(rose, 2e-3, 0.1e-3);
  EXPECT_LT(end.whole.momentum_residual_n, 2e-3 * grip);
}

TEST_F(SceneOf, ALightSoftBodyIsBalancedBesideAHardPress) {
  add_gel("gel", at(Vector3::Zero()));
  TetMesh block = block_gel(2, 4e-3, 4e-3);
  std::fill(block.tags.begin(), block.tags.end(), BoundaryTag::free);
  spec_.bodies.push_back({.name = "block", .kind = BodyKind::soft, .world_from_body = at({-6e-3, 0, 4.1e-3})});
  bodies_.push_back({.tets = block, .material = paper_sensor().material});
  add_box("press", BodyKind::rigid, {5e-3, 0, 3.1e-3});
  spec_.motion = {{.steps = 20, .move = {{.body = 2, .way = {.shift_m = {0, 0, -0.6e-3}}}}}};
  const Scene scene = run();  // each frame passes its verdict
  double mass = 0.0;
  for (const double of_vertex : lumped_masses(block.tets, make_rest_tets(block.positions, block.tets),
                                              block.num_vertices(), paper_sensor().material.density_kg_m3))
    mass += of_vertex;
  const SceneFrame& end = scene.frames.back();
  EXPECT_GT(on(end, 0, 2).force_n.norm(), 1.0);
  EXPECT_NEAR(on(end, 1, 0).force_n.z(), mass * kG, 0.3 * mass * kG);
}

TEST_F(SceneOf, FixedBodiesMayShareFacesAndOneInsideAnotherIsFine) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("left", BodyKind::fixed, {-3e-3, 0, 10e-3});
  add_box("right", BodyKind::fixed, {3e-3, 0, 10e-3});
  add_box("inside", BodyKind::fixed, {3e-3, 0, 10e-3}, {1e-3, 1e-3, 1e-3});
  spec_.motion = {{.steps = 2}};
  EXPECT_EQ(run().frames.size(), 3u);
}

TEST_F(SceneOf, ABodyThatIsThrownBringsItsEnergyAndMomentumFromOutside) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("box", BodyKind::rigid, {0, 0, 20e-3});
  spec_.gravity_m_s2.setZero();
  // Carried by 1 mm in five steps of 10 ms, let go, and caught again.
  spec_.motion = {
      {.steps = 5, .move = {{.body = 1, .way = {.shift_m = {0, 0, 1e-3}}}}}, {.steps = 5}, {.steps = 2, .hold = {1}}};
  const Scene scene = run();
  const double v = 1e-3 / 0.05;
  const WholeAccount &flying = scene.frames[8].whole, &caught = scene.frames.back().whole;
  EXPECT_NEAR(scene.frames[8].velocity_m_s[0].z(), v, 1e-9);
  EXPECT_NEAR(flying.kinetic_j, 0.5 * kBoxMass_kg * v * v, 1e-9);
  EXPECT_NEAR(flying.work_j, flying.kinetic_j, 1e-9);
  EXPECT_NEAR(flying.impulse_n_s.z(), kBoxMass_kg * v, 1e-9);
  EXPECT_NEAR(flying.method_loss_j, 0.0, 1e-9);
  EXPECT_LT(flying.momentum_residual_n, 1e-6);
  EXPECT_NEAR(caught.kinetic_j, 0.0, 1e-9);
  EXPECT_NEAR(caught.work_j, 0.0, 1e-9);
  EXPECT_NEAR(caught.impulse_n_s.z(), 0.0, 1e-9);
}

TEST_F(SceneOf, DampingLetsAGelTurnWithItsMount) {
  add_gel("gel", at(Vector3::Zero()));
  spec_.gravity_m_s2.setZero();
  config_.stiffness_damping_s = 0.02;
  spec_.motion = {{.steps = 6, .move = {{.body = 0, .way = {.turn_rad = {0, 0, 1.0}}}}}};
  const Scene scene = run();
  double strained = 0.0;
  for (const Frame& frame : scene.gels[0].frames)
    strained = std::max(strained, (frame.positions - bodies_[0].tets.positions).cwiseAbs().maxCoeff());
  EXPECT_LT(strained, 1e-5);
}

TEST_F(SceneOf, BodiesThatAreToldToMeetAreAnErrorThatNamesThem) {
  add_gel("gel", at(Vector3::Zero()));
  add_box("peg", BodyKind::rigid, {0, 0, 30e-3});
  add_box("plate", BodyKind::fixed, {0, 0, 20e-3}, {0.01, 0.01, 0.5e-3});
  spec_.motion = {{.steps = 2, .move = {{.body = 1, .way = {.shift_m = {0, 0, -20e-3}}}}}};
  const auto message = [&] {
    try {
      run();
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message(), HasSubstr("peg runs into plate"));
  spec_.bodies[1].world_from_body = at({0, 0, 3.001e-3});
  EXPECT_THAT(message(), HasSubstr("bodies gel and peg are 0.001 mm apart in frame 0"));
}

}  // namespace scene_test
}  // namespace tacipc
