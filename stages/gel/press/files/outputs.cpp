#include "stages/gel/press/files/outputs.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/base/files.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"
#include "common/sample/scene_hold.h"
#include "common/sensor/markers.h"
#include "stages/gel/press/drive/grasp_labels.h"
#include "stages/gel/press/drive/grasp_outcome.h"
#include "stages/gel/press/files/contact_arrays.h"
#include "stages/gel/press/measure/contact_summary.h"
#include "stages/gel/press/measure/verdict.h"

namespace tacipc {
namespace {

void write_markers(Stage& stage, const std::string& folder, const ArrayWriter& writer,
                   const std::vector<Marker>& markers, const std::vector<Frame>& frames,
                   const std::optional<std::size_t>& end) {
  std::vector<Positions> positions;
  for (const Frame& frame : frames) positions.push_back(marker_positions(markers, frame.positions));
  writer.write(PressArray::markers, positions, std::identity());
  writer.write(PressArray::marker_displacement, marker_displacements(positions, end));
  write_file(stage.output(folder + kMarkersCsv), markers_csv(markers));
}

PressFrameLines frame_lines(const Simulation& simulation, const Frame& f) {
  const ContactSummary contact =
      measure_contact(simulation.front, on_front(simulation.front, f.positions), f.normal_force_n, f.contact_state);
  PressFrameLines lines{.time_s = f.time_s,
                        .phase = name_of(f.phase),
                        .press_force_n = 0.0 - f.force_n.z(),
                        .tangential_force_n = f.force_n.head<2>().norm(),
                        .balance_n = f.balance.force_n,
                        .balance_relative = f.balance.relative,
                        .inertia_n = f.balance.inertia_n.norm(),
                        .mount_force_n = f.balance.mount_n.norm(),
                        .contact_area_mm2 = 1e6 * contact.area_m2,
                        .mean_pressure_pa = contact.mean_pressure_pa,
                        .peak_pressure_pa = contact.peak_pressure_pa,
                        .sticking = contact.sticking,
                        .slipping = contact.slipping,
                        .substeps = f.solver.time_steps,
                        .newton_iterations = f.solver.newton_iterations,
                        .patch_iterations = f.solver.patch_iterations,
                        .lag_iterations = f.solver.lag_iterations,
                        .exact_hessian_waits = f.solver.exact_hessian_waits,
                        .approximated_share = f.solver.approximated_share,
                        .friction_residual_n = f.solver.friction_residual_n,
                        .velocity_residual_m_s = f.solver.velocity_residual_m_s,
                        .force_residual_n = f.solver.force_residual_n,
                        .barrier_stiffness = f.solver.barrier_factor * simulation.barrier_stiffness,
                        .min_gap_m = f.min_gap_m,
                        .stand_off_m = f.stand_off_m,
                        .min_volume_ratio = f.min_volume_ratio,
                        .intersections = f.intersections,
                        .inverted_tets = f.inverted_tets,
                        .gel_in_object = f.gel_in_object,
                        .pose_error_m = f.pose_error_m};
  if (f.phase == PhaseKind::free) {
    lines.body_strain = f.body_strain;
    lines.body_load_n = f.solver.body_load_n;
    lines.body_residual_n = f.solver.body_residual_n;
    lines.body_residual_n_m = f.solver.body_residual_n_m;
  }
  return lines;
}

void take_smaller(std::optional<double>& smallest, const std::optional<double>& value) {
  if (value) smallest = std::min(smallest.value_or(*value), *value);
}

/// Adds the frames, the numbers over all of them and those of the last one.
void add_frames(PressSummary& summary, const Simulation& simulation) {
  std::vector<int> approximated;
  for (const Frame& f : simulation.frames) {
    const PressFrameLines& lines = summary.per_frame.emplace_back(frame_lines(simulation, f));
    summary.newton_iterations += lines.newton_iterations;
    if (lines.approximated_share > 0.0) approximated.push_back(static_cast<int>(&f - simulation.frames.data()));
    summary.intersections += lines.intersections;
    summary.inverted_tets += lines.inverted_tets;
    if (touches(f)) ++summary.contact_frames;
    take_smaller(summary.min_distance_m, f.min_gap_m);
    summary.min_volume_ratio = std::min(summary.min_volume_ratio, lines.min_volume_ratio);
    summary.max_balance_relative = std::max(summary.max_balance_relative, lines.balance_relative);
    summary.max_pose_error_m = std::max(summary.max_pose_error_m, lines.pose_error_m);
    if (lines.slipping > 0 && !summary.first_slip_time_s) summary.first_slip_time_s = f.time_s;
    if (lines.slipping > 0 && lines.sticking == 0 && !summary.gross_slip_time_s) summary.gross_slip_time_s = f.time_s;
  }
  if (!approximated.empty()) summary.approximated_frames = std::move(approximated);
  const PressFrameLines& last = summary.per_frame.back();
  summary.barrier_stiffness = last.barrier_stiffness;
  summary.press_force_n = last.press_force_n;
  summary.tangential_force_n = last.tangential_force_n;
  summary.stand_off_m = last.stand_off_m;
}

/// Writes every array of one gel in a folder below --out.
/// \param folder "" or with a slash at its end
/// \param end last frame of the first press
/// \return summary of its record
Value::Map write_gel(Stage& stage, const std::string& folder, const Sensor& sensor, const TetMesh& gel,
                     const std::optional<std::size_t>& end, const Simulation& simulation) {
  const auto& frames = simulation.frames;
  const auto vertices = static_cast<std::size_t>(frames[0].positions.rows());
  const std::vector<Marker> markers = bind_markers(sensor.markers, gel.positions, gel.faces(BoundaryTag::front));
  const ArrayWriter writer(stage,
                           {{kFrames, frames.size()},
                            {kVertices, vertices},
                            {kFrontVertices, simulation.front.vertices.size()},
                            {kMarkers, markers.size()},
                            {kTets, static_cast<std::size_t>(gel.num_tets())}},
                           folder);
  writer.write(PressArray::positions, frames, [](const Frame& f) { return f.positions; });
  writer.write(PressArray::object_pose, frames, [](const Frame& f) { return f.gel_from_object; });
  writer.write(PressArray::time, frames, [](const Frame& f) { return f.time_s; });
  writer.write(PressArray::phase, frames, [](const Frame& f) { return f.phase; });
  writer.write(PressArray::wrench, frames, [](const Frame& f) { return Wrench{f.force_n, f.torque_n_m}; });
  if (simulation.object_may_be_free) {
    writer.write(PressArray::object_twist, frames, [](const Frame& f) {
      return Twist{f.object_velocity_m_s, f.object_spin_rad_s};
    });
  }
  if (simulation.mount_gives_way)
    writer.write(PressArray::holder_pose, frames, [](const Frame& f) { return f.holder_pose; });
  write_contact(writer, sensor, simulation);
  write_stress(writer, gel, simulation);
  write_markers(stage, folder, writer, markers, frames, end);

  PressSummary summary{
      .frames = frames.size(),
      .gel_vertices = vertices,
      .d_hat_m = simulation.d_hat_m,
      .element = simulation.element,
      .friction_coefficient = simulation.friction,
      .min_volume_ratio = 1.0,
      .press_end_frame = end,
      // A simulation that gets here has passed judge_frame() in every frame; a failure would have thrown an error.
      .converged = true,
      .verdict = kPassed,
      .limits = kVerdictLimits};
  if (!simulation.face.empty()) summary.face = simulation.face;
  if (simulation.object_mass_kg > 0.0) summary.object_mass_kg = simulation.object_mass_kg;
  add_frames(summary, simulation);
  return record_lines(summary);
}

void add_cost(Stage& stage, const SolverTimes& t) {
  stage.cost({{"search_s", t.search_s},
              {"step_limits_s", t.limits_s},
              {"line_search_s", t.line_search_s},
              {"elastic_s", t.elastic_s},
              {"contact_s", t.contact_s},
              {"linear_s", t.linear_s},
              {"patches_s", t.patches_s},
              {"linear_systems", t.solves},
              {"factorised_systems", t.factorised},
              {"products", t.products}});
}

/// Energy and momentum of the whole over the frames, as files.
struct WholeArrays {
  std::vector<double> energy, momentum;
  double momentum_residual_n = 0.0;

  void add(const WholeAccount& whole) {
    energy.insert(energy.end(), {whole.kinetic_j, whole.elastic_j, whole.contact_j, whole.gravitational_j, whole.work_j,
                                 whole.friction_loss_j, whole.damping_loss_j, whole.method_loss_j});
    for (const Vector3* row : {&whole.momentum_kg_m_s, &whole.angular_momentum_kg_m2_s, &whole.impulse_n_s,
                               &whole.angular_impulse_n_m_s, &whole.method_angular_n_m_s})
      momentum.insert(momentum.end(), row->begin(), row->end());
    momentum_residual_n = std::max(momentum_residual_n, whole.momentum_residual_n);
  }
  template <typename Array>
  void write(const ArrayWriter& writer) const {
    writer.write(Array::energy, energy);
    writer.write(Array::momentum, momentum);
  }
};

GraspFrameLines grasp_lines(const Grasp& grasp, std::size_t frame) {
  const GraspFrame& f = grasp.frames[frame];
  const auto& [left, right] = grasp.contacts[frame];
  const Frame& finger = grasp.fingers[0].frames[frame];
  const Vector3 carried = f.force_on_finger_n[0] + f.force_on_finger_n[1];
  GraspFrameLines lines{.time_s = f.time_s,
                        .phase = name_of(f.phase),
                        .grip_left_n = f.grip_n(0),
                        .grip_right_n = f.grip_n(1),
                        .carried_n = 0.0 - carried.z(),
                        .height_m = f.world_from_object(2, 3),
                        .hand_height_m = f.world_from_hand(2, 3),
                        .slip_m = f.slip_m,
                        .turn_rad = f.turn_rad,
                        .slip_share_left = left.slip_share,
                        .slip_share_right = right.slip_share,
                        .friction_radius_left_m = left.friction_radius_m,
                        .friction_radius_right_m = right.friction_radius_m,
                        .body_strain = finger.body_strain,
                        .body_load_n = finger.solver.body_load_n,
                        .body_residual_n = finger.solver.body_residual_n,
                        .momentum_residual_n = f.whole.momentum_residual_n,
                        .angular_residual_n_m = f.whole.angular_residual_n_m,
                        .grip_imbalance = f.grip_imbalance};
  if (const std::size_t since = frame - grasp.freed_frame;
      frame >= grasp.freed_frame && since < grasp.friction_use.size() && std::isfinite(grasp.friction_use[since]))
    lines.friction_use = grasp.friction_use[since];
  return lines;
}

/// Slip times of one finger; nothing if it never slips.
std::optional<SlipLines> slip_lines(const SlipTimes& times) {
  if (!times.first_s && !times.gross_s) return std::nullopt;
  return SlipLines{.first_slip_s = times.first_s, .gross_slip_s = times.gross_s};
}

HeldPoseLines pose_lines(const GraspPose& pose) {
  Eigen::Quaterniond q(pose.world_from_object);
  if (q.w() < 0.0) q.coeffs() *= -1.0;
  // Adding zero turns −0 into 0.
  return {.rotation_xyzw = {q.x() + 0.0, q.y() + 0.0, q.z() + 0.0, q.w()},
          .grip_m = pose.grip_m,
          .lever_m = pose.lever_m(),
          .width_m = pose.width_m,
          .patch_m = pose.patch_m};
}

/// Rigid bodies that the gels hold.
std::vector<HeldBodyLines> held_by_gels(const SceneSpec& spec, const Scene& scene) {
  const std::vector<SceneFrame>& frames = scene.frames;
  HeldContacts contacts{.slip_speed_m_s = scene.slip_speed_m_s};
  SceneBodies all;
  for (const BodySpec& body : spec.bodies) {
    all.bodies.push_back(body.name);
    all.kinds.emplace_back(kBodyKinds[static_cast<std::size_t>(body.kind)]);
  }
  std::vector<std::size_t> free_from(spec.bodies.size(), 0);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    all.per_frame.push_back(frames[f].between);
    all.body_pose.push_back(frames[f].world_from_body);
    HeldContact& contact = contacts.per_frame.emplace_back();
    contact.seconds = f > 0 ? frames[f].time_s - frames[f - 1].time_s : 0.0;
    for (const Simulation& gel : scene.gels) {
      const FingerContact of_gel = finger_contact(gel.front, gel.frames[f]);
      contact.slip_share = std::max(contact.slip_share, of_gel.slip_share);
      contact.radius_m = std::max(contact.radius_m, of_gel.friction_radius_m);
    }
    if (frames[f].phase_index < 0) continue;
    const ScenePhase& phase = spec.motion[static_cast<std::size_t>(frames[f].phase_index)];
    for (const int body : phase.hold) free_from[static_cast<std::size_t>(body)] = f;
    for (const WaySpec& way : phase.move) free_from[static_cast<std::size_t>(way.body)] = f;
  }
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (!spec.bodies[b].path.empty()) free_from[b] = frames.size() - 1;
  return held_bodies(all, free_from, contacts);
}

}  // namespace

void write_outputs(Stage& stage, const Sensor& sensor, const TetMesh& gel, const SampleSpec& sample,
                   const Simulation& simulation) {
  std::vector<int> phases;
  for (const Frame& f : simulation.frames) phases.push_back(f.phase_index);
  stage.summarize(write_gel(stage, "", sensor, gel, press_end_frame(sample, phases), simulation));
  add_cost(stage, simulation.times);
}

void write_outputs(Stage& stage, const Sensor& sensor, const TetMesh& gel, const Grasp& grasp) {
  const auto& frames = grasp.frames;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::string folder = std::string(side == 0 ? "left" : "right") + "/press";
    stage.finish_part(folder, write_gel(stage, folder + "/", sensor, gel, grasp.freed_frame, grasp.fingers[side]));
  }
  WholeArrays whole;
  std::vector<GraspFrameLines> per_frame;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    whole.add(frames[i].whole);
    per_frame.push_back(grasp_lines(grasp, i));
  }
  const std::size_t n = frames.size();
  const ArrayWriter writer(stage, {{kFrames, n}});
  writer.write(GraspArray::time, frames, &GraspFrame::time_s);
  writer.write(GraspArray::object_world_pose, frames, &GraspFrame::world_from_object);
  writer.write(GraspArray::object_world_twist, frames, [](const GraspFrame& f) {
    return Twist{f.velocity_m_s, f.spin_rad_s};
  });
  writer.write(GraspArray::hand_pose, frames, &GraspFrame::world_from_hand);
  writer.write(GraspArray::finger_pose, frames, &GraspFrame::world_from_finger);
  writer.write(GraspArray::finger_force, frames, &GraspFrame::force_on_finger_n);
  writer.write(GraspArray::finger_drive, frames, [](const GraspFrame& f) {
    std::vector<double> drives;
    for (const FingerDrive& drive : f.drives)
      drives.insert(drives.end(), {drive.force_n, drive.closed_m, drive.velocity_m_s});
    return drives;
  });
  whole.write<GraspArray>(writer);
  const GraspFrame& judged = frames[grasp.judged_frame];
  const Rise rise = rise_of(frames[grasp.freed_frame], judged, grasp.grip_point());
  GraspSummary summary{.frames = n,
                       .outcome = kGraspOutcomes[static_cast<std::size_t>(grasp.outcome)],
                       .freed_frame = grasp.freed_frame,
                       .judged_frame = grasp.judged_frame,
                       .object_mass_kg = grasp.mass_kg,
                       .friction_coefficient = grasp.friction,
                       .gravity_m_s2 = grasp.gravity_m_s2,
                       .center_of_mass_m = grasp.center_of_mass_m,
                       .center_of_mass_shift_m = grasp.center_shift_m,
                       .pose = pose_lines(grasp.pose),
                       .grip_n = grasp.grip_n,
                       .slip_m = judged.slip_m,
                       .turn_rad = judged.turn_rad,
                       .creep_m = judged.creep_m,
                       .creep_rad = judged.creep_rad,
                       .rise_m = rise.object_m,
                       .hand_rise_m = rise.hand_m,
                       .slip_speed_m_s = grasp.slip_speed_m_s,
                       .max_momentum_residual_n = whole.momentum_residual_n,
                       .slip_left = slip_lines(grasp.slips[0]),
                       .slip_right = slip_lines(grasp.slips[1]),
                       .converged = true,
                       .verdict = kPassed,
                       .per_frame = std::move(per_frame)};
  if (grasp.reason) summary.reason = kGraspReasons[static_cast<std::size_t>(*grasp.reason)];
  if (grasp.weight_n > 0.0) summary.friction_margin = 2.0 * grasp.friction * grasp.grip_n / grasp.weight_n;
  stage.summarize(record_lines(summary));
  add_cost(stage, grasp.fingers[0].times);
}

void write_outputs(Stage& stage, const Sensor& sensor, const std::vector<SceneBody>& bodies, const SceneSpec& spec,
                   const Scene& scene) {
  for (std::size_t g = 0; g < scene.gels.size(); ++g) {
    const std::string folder = "gels/" + spec.bodies[g].name + "/press";
    stage.finish_part(folder, write_gel(stage, folder + "/", sensor, bodies[g].tets, std::nullopt, scene.gels[g]));
  }
  const std::vector<SceneFrame>& frames = scene.frames;
  const std::size_t n = frames.size(), count = spec.bodies.size(), rigid = scene.mass_kg.size(),
                    deformable = scene.gels.size() + frames[0].soft_m.size();
  WholeArrays whole;
  SceneSummary summary{.frames = n, .converged = true, .verdict = kPassed};
  for (std::size_t g = 0; g < scene.gels.size(); ++g)
    if (std::none_of(scene.gels[g].frames.begin(), scene.gels[g].frames.end(), touches))
      summary.untouched_gels.push_back(spec.bodies[g].name);
  for (const SceneFrame& f : frames) {
    for (const double strain : f.strain) summary.body_strain = std::max(summary.body_strain, strain);
    whole.add(f.whole);
    summary.intersections += f.intersections;
    take_smaller(summary.min_distance_m, f.min_gap_m);
    if (f.solver.body_load_n > 0.0)
      summary.max_body_balance_relative =
          std::max(summary.max_body_balance_relative,
                   f.solver.body_residual_n / std::max(f.solver.body_load_n, kSmallestBodyLoadN));
    summary.per_frame.push_back({.time_s = f.time_s,
                                 .phase = f.phase_index,
                                 .time_steps = f.solver.time_steps,
                                 .newton_iterations = f.solver.newton_iterations,
                                 .velocity_residual_m_s = f.solver.velocity_residual_m_s,
                                 .force_residual_n = f.solver.force_residual_n,
                                 .body_residual_n = f.solver.body_residual_n,
                                 .body_load_n = f.solver.body_load_n,
                                 .min_gap_m = f.min_gap_m,
                                 .intersections = f.intersections});
  }
  summary.max_momentum_residual_n = whole.momentum_residual_n;
  const ArrayWriter writer(stage, {{kFrames, n}, {kBodies, count}, {kRigidBodies, rigid}});
  writer.write(SceneArray::time, frames, &SceneFrame::time_s);
  writer.write(SceneArray::body_pose, frames, &SceneFrame::world_from_body);
  if (rigid > 0) {
    writer.write(SceneArray::body_twist, frames, [rigid](const SceneFrame& f) {
      std::vector<Twist> twists;
      for (std::size_t i = 0; i < rigid; ++i) twists.push_back({f.velocity_m_s[i], f.spin_rad_s[i]});
      return twists;
    });
  }
  writer.write(SceneArray::pair_wrench, frames, &SceneFrame::between);
  whole.write<SceneArray>(writer);
  for (std::size_t i = 0; i < frames[0].soft_m.size(); ++i) {
    const auto vertices = static_cast<std::size_t>(frames[0].soft_m[i].rows());
    ArrayWriter(stage, {{kFrames, n}, {kVertices, vertices}})
        .write(field_named(field_of(SceneArray::soft_positions), spec.bodies[scene.gels.size() + i].name), frames,
               [i](const SceneFrame& f) -> const Positions& { return f.soft_m[i]; });
  }
  for (std::size_t b = 0; b < count; ++b) {
    const BodyKind kind = spec.bodies[b].kind;
    SceneBodyLines& body = summary.bodies.emplace_back(
        SceneBodyLines{.name = spec.bodies[b].name, .kind = kBodyKinds[static_cast<std::size_t>(kind)]});
    if (b >= deformable) body.metres_per_unit = spec.bodies[b].metres_per_unit;
    if (kind == BodyKind::rigid) body.mass_kg = scene.mass_kg[b - deformable];
  }
  for (std::size_t i = 0; i < spec.contact.size(); ++i) {
    const auto name = [&](int side) {
      return spec.bodies[static_cast<std::size_t>(spec.contact[i].between[side])].name;
    };
    summary.contact.push_back({{name(0), name(1)}, scene.contact[i].friction, scene.contact[i].d_hat_m});
  }
  summary.held = held_by_gels(spec, scene);
  stage.summarize(record_lines(summary));
  add_cost(stage, scene.times);
}

}  // namespace tacipc
