// Small grasps: two blocks of gel and a box between them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stages/gel/press/drive/grasp.h"
#include "tests/make_mesh.h"
#include "tests/stages/gel/press/drive/memory_store.h"
#include "tests/stages/gel/press/reference_scene.h"
#include "tests/stages/gel/press/small_scene.h"

namespace tacipc {

constexpr double kG = 9.81;

/// A box around the origin.
inline TriangleMesh centered_box(const Vector3& half_m) { return make_box(-half_m, half_m); }

inline PressConfig grasp_config(double coefficient) {
  PressConfig config = friction_config(coefficient);
  config.pair_counting.once = true;
  return config;
}

inline GraspPhase close_phase(int steps, double force_n) {
  return {.kind = PhaseKind::close, .steps = steps, .force_n = force_n};
}
inline GraspPhase close_to_phase(int steps, double width_m) {
  return {.kind = PhaseKind::close, .steps = steps, .width_m = width_m};
}
inline GraspPhase approach_phase(int steps, double gap_m) {
  return {.kind = PhaseKind::approach, .steps = steps, .gap_m = gap_m};
}
inline GraspPhase turn_phase(int steps, double angle_rad, int axis) {
  return {.kind = PhaseKind::turn, .steps = steps, .axis = axis, .angle_rad = angle_rad};
}
inline GraspPhase hold_phase(int steps) { return {.kind = PhaseKind::hold, .steps = steps}; }
inline GraspPhase lift_phase(int steps, double distance_m) {
  return {.kind = PhaseKind::lift, .steps = steps, .distance_m = distance_m};
}
inline GraspPhase release_phase(int steps, double distance_m) {
  return {.kind = PhaseKind::release, .steps = steps, .distance_m = distance_m};
}

inline GraspSpec grasp_of(double mass_kg, std::vector<GraspPhase> motion) {
  GraspSpec spec;
  spec.mass_kg = mass_kg;
  spec.motion = std::move(motion);
  return spec;
}

inline Grasp run_grasp(const TriangleMesh& object, const PressConfig& config, const GraspSpec& spec,
                       FrameStore* store = nullptr, const TetMesh& gel = block_gel(6, 0.02, 0.002)) {
  return grasp(paper_sensor(), gel, object, config, spec, ignore_progress, store);
}

}  // namespace tacipc
