// Presses of the reference IPC solver, made again here with the same mesh, material, barrier and tolerance.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "common/format/npy.h"
#include "stages/gel/press/drive/simulate.h"

namespace tacipc {

inline Sensor paper_sensor() {
  return read_config<Sensor>(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/mctac.yaml");
}
inline PressConfig paper_config() {
  return read_config<PressConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/press/paper.yaml");
}
/// With friction that is consistent with the contact forces at the end of each step.
inline PressConfig friction_config(double coefficient) {
  PressConfig config = paper_config();
  config.friction = FrictionConfig{.coefficient = coefficient,
                                   .relative_speed_threshold = 1e-3,
                                   .iterated = true,
                                   .max_lag_iterations = 50,
                                   .relative_lag_tolerance = 1e-2};
  return config;
}
inline void ignore_progress(int, int, int, double) {}

struct ReferenceComparison {
  std::vector<double> press_force_n;  // frames 1, 2, …
  std::vector<double> tangential_force_n;
  double rms_m = 0.0;  // difference of vertex displacements in the last frame
  double largest_m = 0.0;
  double front_rms_m = 0.0;  // of the front face alone
  double front_largest_m = 0.0;
  double front_99_m = 0.0;  // 99 % of its vertices are no further off
};

/// The reference's sphere, 0.45 mm deep in five steps from 0.05 mm above. Its object is held by a penalty only, so that
/// single vertices of it lag by up to 1.6 um, and so does the gel under them.
inline ReferenceComparison compare_with_reference(const std::filesystem::path& folder, const std::string& gel_file,
                                                  const std::string& object_file, const std::string& scene,
                                                  bool shear = false) {
  const MshContent content = read_msh(folder / gel_file);
  TetMesh gel{content.positions, content.tets, boundary_triangles(content.tets, content.positions.rows()), {}};
  gel.positions.col(2).array() -= 2e-3;  // front at z = 0
  for (Eigen::Index f = 0; f < gel.boundary.rows(); ++f) {
    double highest = -1.0;
    for (int c = 0; c < 3; ++c) highest = std::max(highest, gel.positions(gel.boundary(f, c), 2));
    gel.tags.push_back(highest < -2e-3 + 1e-9 ? BoundaryTag::glued : BoundaryTag::front);
  }
  const TriangleMesh object = read_triangle_mesh(folder / object_file, 1.0);
  PressConfig config = paper_config();
  const Vector3 extent = gel.positions.colwise().maxCoeff() - gel.positions.colwise().minCoeff();
  config.start_gap_d_hat = 0.05e-3 / (config.relative_d_hat * extent.norm());
  SampleSpec sample;
  sample.motion = {{.kind = PhaseKind::press, .steps = 5, .depth_m = 0.45e-3}};
  if (shear) {
    sample.motion.push_back({.kind = PhaseKind::shear, .steps = 5, .shift_m = {0.5e-3, 0.0, 0.0}});
    config.friction = FrictionConfig{.coefficient = 0.5, .relative_speed_threshold = 1e-3};
  }
  const Simulation simulation = simulate(paper_sensor(), gel, object, config, sample, "-z", ignore_progress);

  ReferenceComparison out;
  for (std::size_t f = 1; f < simulation.frames.size(); ++f) {
    out.press_force_n.push_back(-simulation.frames[f].force_n.z());
    out.tangential_force_n.push_back(simulation.frames[f].force_n.head<2>().norm());
  }
  const NpyArray reference = read_npy(folder / (scene + "_gel_displacement.npy"));
  const double* last = reference.data.data() + 3 * gel.num_vertices() * (simulation.frames.size() - 1);
  std::vector<double> front;
  for (Eigen::Index v = 0; v < gel.num_vertices(); ++v) {
    const Vector3 moved = simulation.frames.back().positions.row(v) - gel.positions.row(v);
    const double difference = (moved - Vector3(last[3 * v], last[3 * v + 1], last[3 * v + 2])).norm();
    out.rms_m += difference * difference;
    out.largest_m = std::max(out.largest_m, difference);
    if (gel.positions(v, 2) > -1e-9) front.push_back(difference);
  }
  out.rms_m = std::sqrt(out.rms_m / static_cast<double>(gel.num_vertices()));
  std::sort(front.begin(), front.end());
  for (const double difference : front) out.front_rms_m += difference * difference;
  out.front_rms_m = std::sqrt(out.front_rms_m / static_cast<double>(front.size()));
  out.front_largest_m = front.back();
  out.front_99_m = front[front.size() * 99 / 100];
  return out;
}

}  // namespace tacipc
