#include "stages/press/outputs.h"

#include <algorithm>

#include "common/npy.h"

namespace tacipc {
namespace {

/// Stacks one row-major array per frame.
template <typename Part>
void write_stacked(const std::filesystem::path& path, const std::vector<Frame>& frames, std::vector<std::size_t> shape,
                   Part&& part) {
  std::vector<double> all;
  for (const Frame& frame : frames) part(frame, all);
  shape.insert(shape.begin(), frames.size());
  write_npy(path, shape, all.data());
}

void append(std::vector<double>& all, const auto& matrix) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) all.push_back(matrix(i, j));
  }
}

}  // namespace

void write_outputs(Stage& stage, const Simulation& simulation) {
  const auto& frames = simulation.frames;
  const auto vertices = static_cast<std::size_t>(frames[0].positions.rows());
  write_stacked(stage.output("positions.npy"), frames, {vertices, 3},
                [](const Frame& f, auto& all) { append(all, f.positions); });
  write_stacked(stage.output("object_pose.npy"), frames, {4, 4},
                [](const Frame& f, auto& all) { append(all, f.gel_from_object); });
  write_stacked(stage.output("contact_force.npy"), frames, {vertices, 3},
                [](const Frame& f, auto& all) { append(all, f.contact_force); });
  write_stacked(stage.output("wrench.npy"), frames, {6}, [](const Frame& f, auto& all) {
    append(all, f.force_n);
    append(all, f.torque_n_m);
  });

  int iterations = 0;
  double min_gap_m = simulation.gap_horizon_m, min_ratio = 1.0;
  Value::List per_frame;
  for (const Frame& f : frames) {
    iterations += f.solver.newton_iterations;
    min_gap_m = std::min(min_gap_m, f.min_gap_m);
    min_ratio = std::min(min_ratio, f.min_volume_ratio);
    per_frame.emplace_back(Value::Map{{"press_force_n", 0.0 - f.force_n.z()},
                                      {"mount_balance_n", (f.force_n + f.mount_force_n).norm()},
                                      {"newton_iterations", f.solver.newton_iterations},
                                      {"velocity_residual_m_s", f.solver.velocity_residual_m_s},
                                      {"force_residual_n", f.solver.force_residual_n},
                                      {"min_gap_m", f.min_gap_m},
                                      {"min_volume_ratio", f.min_volume_ratio}});
  }
  // A simulation that gets here has passed every check of every frame; one that did not has thrown.
  stage.summarize({{"frames", frames.size()},
                   {"gel_vertices", vertices},
                   {"face", simulation.face},
                   {"d_hat_m", simulation.d_hat_m},
                   {"newton_iterations", iterations},
                   {"symbolic_analyses", simulation.symbolic_analyses},
                   {"press_force_n", 0.0 - frames.back().force_n.z()},
                   {"min_distance_m", min_gap_m},
                   {"min_volume_ratio", min_ratio},
                   {"intersections", 0},
                   {"inverted_tets", 0},
                   {"converged", true},
                   {"per_frame", std::move(per_frame)}});
}

}  // namespace tacipc
