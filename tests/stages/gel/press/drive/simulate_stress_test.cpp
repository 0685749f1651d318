// Stress in pressed gels: in balance inside, equal to the contact on the front, as near to it pointwise as the mesh is
// fine.
#include <gmock/gmock.h>

#include <cmath>

#include "stages/gel/press/drive/checkpoint.h"
#include "stages/gel/press/measure/front_traction.h"
#include "tests/stages/gel/press/drive/memory_store.h"
#include "tests/stages/gel/press/elastic_block.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {
namespace simulate_stress_test {

PressConfig stress_config(const std::string& element) {
  PressConfig config = friction_config(0.4);
  config.element = element;
  config.quasi_static = true;
  config.newton.relative_force_tolerance = 1e-6;
  config.newton.force_tolerance_n = 1e-9;
  config.friction->relative_lag_tolerance = 1e-5;
  config.stress = true;
  return config;
}

SampleSpec press_and_shear() {
  SampleSpec sample = press(0.4e-3, 3);
  sample.motion.push_back({.kind = PhaseKind::shear, .steps = 2, .shift_m = {0.2e-3, 0.1e-3, 0.0}});
  return sample;
}

Simulation run(const Sensor& sensor, const PressConfig& config, FrameStore* store = nullptr) {
  return simulate(sensor, block_gel(8, 0.02, 0.002), pyramid(0.003, 0.002), config, press_and_shear(), "-z",
                  ignore_progress, store);
}

/// Σ_t v_t σ_t ∇ₓNᵢ of each vertex, N: what must be balanced from outside.
Positions nodal_forces(const TetMesh& gel, const Frame& frame) {
  const std::vector<RestTet> now = make_rest_tets(frame.positions, gel.tets);
  Positions force = Positions::Zero(gel.num_vertices(), 3);
  for (Eigen::Index t = 0; t < gel.num_tets(); ++t) {
    const RestTet& tet = now[static_cast<std::size_t>(t)];
    const TetCorners corners = tet.volume_m3 * symmetric(frame.stress_pa, t) * tet.shape_gradients;
    for (int k = 0; k < 4; ++k) force.row(gel.tets(t, k)) += corners.col(k).transpose();
  }
  return force;
}

/// Inside and on free sides nothing is left; on the front what the object pushes and drags with; at the mount its
/// reaction. With relaxation the stress is that with all it remembers.
TEST(Stress, IsInBalanceInsideAndEqualsTheContactOnTheFront) {
  const TetMesh gel = block_gel(8, 0.02, 0.002);
  const std::vector<int> glued = gel.vertices(BoundaryTag::glued);
  for (const char* element : {"linear", "averaged_volume"}) {
    for (const bool relaxes : {false, true}) {
      Sensor sensor = paper_sensor();
      if (relaxes) sensor.material.relaxation = {{0.3, 0.02}, {0.2, 0.1}};
      const Simulation found = run(sensor, stress_config(element));
      ASSERT_EQ(found.frames[0].stress_pa.rows(), gel.num_tets());
      EXPECT_LT(found.frames[0].stress_pa.norm(), 1e-6) << "at rest";
      for (std::size_t f = 1; f < found.frames.size(); ++f) {
        const Frame& frame = found.frames[f];
        Positions left = nodal_forces(gel, frame), contact = Positions::Zero(gel.num_vertices(), 3);
        contact(found.front.vertices, Eigen::all) = frame.normal_force_n + frame.friction_force_n;
        const Vector3 mount = left(glued, Eigen::all).colwise().sum();
        EXPECT_LT((mount - frame.balance.mount_n).norm(), 1e-5 * frame.force_n.norm()) << element << relaxes << f;
        left(glued, Eigen::all).setZero();
        EXPECT_GT(frame.force_n.norm(), 0.01);
        EXPECT_LT((left - contact).rowwise().norm().sum(), 2e-5 * contact.rowwise().norm().sum())
            << element << relaxes << f;
      }
    }
  }
}

/// A gel that relaxes carries more stress than its long-term modulus gives at the same place.
TEST(Stress, OfAGelThatRelaxesHasWhatItRemembers) {
  Sensor sensor = paper_sensor();
  sensor.material.relaxation = {{0.5, 1e6}};
  const PressConfig config = stress_config("averaged_volume");
  const Simulation relaxing = run(sensor, config);
  Sensor stiff = paper_sensor();
  stiff.material.youngs_modulus_pa *= 2.0;  // E₀ of the former, whose file says E∞
  const Simulation elastic = run(stiff, config);
  const SymmetricRows &a = relaxing.frames[3].stress_pa, &b = elastic.frames[3].stress_pa;
  EXPECT_LT((a - b).norm(), 1e-4 * b.norm());
}

TEST(Stress, IsMeasuredOnlyWhereItIsWanted) {
  PressConfig config = stress_config("linear");
  config.stress = false;
  for (const Frame& frame : run(paper_sensor(), config).frames) EXPECT_EQ(frame.stress_pa.rows(), 0);
}

TEST(Stress, GoesOnFromAnyFrameToTheSameBytes) {
  Sensor sensor = paper_sensor();
  sensor.material.relaxation = {{0.3, 0.02}};
  const PressConfig config = stress_config("averaged_volume");
  MemoryStore whole;
  const Simulation expected = run(sensor, config, &whole);
  MemoryStore rest({whole.saved.begin(), whole.saved.begin() + 3});
  const Simulation found = run(sensor, config, &rest);
  EXPECT_TRUE(rest.saved == whole.saved);
  for (std::size_t f = 0; f < expected.frames.size(); ++f)
    EXPECT_EQ(found.frames[f].stress_pa, expected.frames[f].stress_pa) << f;
}

/// A cylinder of a quarter's turn with its axis along y, round side down, wider than the gel: a smooth contact.
TriangleMesh roller(double radius_m, double half_length_m, int parts) {
  TriangleMesh mesh;
  mesh.positions.resize(4 * (parts + 1), 3);
  mesh.triangles.resize(8 * parts + 4, 3);
  const auto vertex = [&](int i, int end, int layer) { return 4 * i + 2 * layer + end; };
  for (int i = 0; i <= parts; ++i) {
    const double angle = 0.7 * (2.0 * i / parts - 1.0), x = radius_m * std::sin(angle);
    for (int end = 0; end < 2; ++end) {
      const double y = half_length_m * (2 * end - 1);
      mesh.positions.row(vertex(i, end, 0)) << x, y, radius_m * (1.0 - std::cos(angle));
      mesh.positions.row(vertex(i, end, 1)) << x, y, radius_m;
    }
  }
  Eigen::Index row = 0;
  const auto quad = [&](int a, int b, int c, int d) {
    mesh.triangles.row(row++) << a, b, c;
    mesh.triangles.row(row++) << a, c, d;
  };
  for (int i = 0; i < parts; ++i) {
    quad(vertex(i, 0, 0), vertex(i, 1, 0), vertex(i + 1, 1, 0), vertex(i + 1, 0, 0));  // round side, down
    quad(vertex(i, 0, 1), vertex(i + 1, 0, 1), vertex(i + 1, 1, 1), vertex(i, 1, 1));  // flat top
    quad(vertex(i, 0, 0), vertex(i + 1, 0, 0), vertex(i + 1, 0, 1), vertex(i, 0, 1));  // ends
    quad(vertex(i, 1, 0), vertex(i, 1, 1), vertex(i + 1, 1, 1), vertex(i + 1, 1, 0));
  }
  quad(vertex(0, 0, 0), vertex(0, 0, 1), vertex(0, 1, 1), vertex(0, 1, 0));
  quad(vertex(parts, 0, 0), vertex(parts, 1, 0), vertex(parts, 1, 1), vertex(parts, 0, 1));
  return mesh;
}

TetMesh fine_gel(int n) {
  const Block block = make_block({0.008, 0.004, 0.002}, {4 * n, 2 * n, n}, 0.0);
  TetMesh gel{block.rest, block.tets, {}, {}};
  gel.positions.rowwise() -= Eigen::RowVector3d(0.004, 0.002, 0.002);
  gel.boundary = boundary_triangles(gel.tets, gel.num_vertices());
  for (Eigen::Index f = 0; f < gel.boundary.rows(); ++f) {
    const Vector3 z = gel.positions(gel.boundary.row(f), 2);
    gel.tags.push_back(z.maxCoeff() < -0.002 + 1e-9 ? BoundaryTag::glued
                       : z.minCoeff() > -1e-9       ? BoundaryTag::front
                                                    : BoundaryTag::side);
  }
  return gel;
}

/// Pressure of σ n against that of the forces over the front, in the mean over its area, as a part of the latter's
/// mean.
TEST(Stress, OnTheFrontNearsTheContactAsTheMeshGetsFiner) {
  std::vector<double> errors;
  for (const int n : {3, 6, 12}) {
    const TetMesh gel = fine_gel(n);
    PressConfig config = stress_config("averaged_volume");
    config.friction.reset();
    config.newton.relative_force_tolerance = 1e-4;
    const Simulation found =
        simulate(paper_sensor(), gel, roller(0.01, 0.003, 96), config, press(0.2e-3, 1), "-z", ignore_progress);
    const Frame& frame = found.frames[1];
    const Positions x = on_front(found.front, frame.positions);
    const std::vector<double> areas = lumped_areas(found.front, x);
    const FrontTraction forces = traction_of_forces(found.front, x, frame.normal_force_n);
    const FrontTraction stress =
        traction_of_stress(found.front, x, frame.stress_pa, tets_behind(found.front, gel.tets));
    double difference = 0.0, all = 0.0;
    for (std::size_t v = 0; v < areas.size(); ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      difference += areas[v] * std::abs(forces.pressure[row] - stress.pressure[row]);
      all += areas[v] * std::abs(forces.pressure[row]);
    }
    errors.push_back(difference / all);
  }
  EXPECT_LT(errors[1], 0.6 * errors[0]) << errors[0] << " " << errors[1] << " " << errors[2];
  EXPECT_LT(errors[2], 0.6 * errors[1]) << errors[0] << " " << errors[1] << " " << errors[2];
  EXPECT_LT(errors[2], 0.08);
}

}  // namespace simulate_stress_test
}  // namespace tacipc
