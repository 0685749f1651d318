// The record of `press`: summary and per-frame lines of a press, grasp or scene run. The only unit that names its keys.
// A key's suffix gives its unit. Lengths of a grasp or scene are in the world, others in S.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "common/base/types.h"
#include "common/stage/record_lines.h"

namespace tacipc {

/// Limits that every frame satisfies; docs/verdict.md gives the reason for each.
struct PressLimits {
  double smallest_distance_m = 0.0;  // least distance between gel and object; must be exceeded
  int intersections = 0;             // pairs of triangles that share a point, by an exact test
  double gel_in_object = 0.0;        // winding number of the object's surface around the gel
  int inverted_tets = 0;             // tetrahedra whose volume is not positive, by an exact test
  double volume_ratio = 0.0;         // smallest deformed over undeformed volume; must be exceeded
  double balance_relative = 0.0;     // force residual over contact force, which counts as smallest_contact_n at least
  double smallest_contact_n = 0.0;
  double pose_error_m = 0.0;           // largest distance of an object vertex from its prescribed position
  double body_strain = 0.0;            // strain of a free object: max |AᵀA − I|
  double body_balance_relative = 0.0;  // residual of its momentum balance over its weight or load, whichever is larger
  double body_torque_relative = 0.0;   // residual of its angular momentum balance over that load times the arm
  double body_torque_arm_m = 0.0;      // length of the arm
  double smallest_body_load_n = 0.0;   // lower bound of the weight or load

  static constexpr auto keys() {
    using Lines = PressLimits;
    return std::tuple(RECORD_KEY(smallest_distance_m), RECORD_KEY(intersections), RECORD_KEY(gel_in_object),
                      RECORD_KEY(inverted_tets), RECORD_KEY(volume_ratio), RECORD_KEY(balance_relative),
                      RECORD_KEY(smallest_contact_n), RECORD_KEY(pose_error_m), RECORD_KEY(body_strain),
                      RECORD_KEY(body_balance_relative), RECORD_KEY(body_torque_relative),
                      RECORD_KEY(body_torque_arm_m), RECORD_KEY(smallest_body_load_n));
  }
};

/// One frame of a press.
struct PressFrameLines {
  double time_s = 0.0;
  std::string phase = {};
  double press_force_n = 0.0, tangential_force_n = 0.0;  // forces of the object on the gel: against z, and across z
  double balance_n = 0.0, balance_relative = 0.0, inertia_n = 0.0, mount_force_n = 0.0;
  double contact_area_mm2 = 0.0, mean_pressure_pa = 0.0, peak_pressure_pa = 0.0;
  int sticking = 0, slipping = 0;  // numbers of front vertices
  int substeps = 0, newton_iterations = 0, patch_iterations = 0, lag_iterations = 0, exact_hessian_waits = 0;
  double approximated_share = 0.0;
  double friction_residual_n = 0.0, velocity_residual_m_s = 0.0, force_residual_n = 0.0, barrier_stiffness = 0.0;
  std::optional<double> min_gap_m = {};  // absent if nothing is near
  double stand_off_m = 0.0, min_volume_ratio = 0.0;
  int intersections = 0, inverted_tets = 0;
  double gel_in_object = 0.0, pose_error_m = 0.0;
  // only for a free object
  std::optional<double> body_strain = {}, body_load_n = {}, body_residual_n = {}, body_residual_n_m = {};

  static constexpr auto keys() {
    using Lines = PressFrameLines;
    return std::tuple(
        RECORD_KEY(time_s), RECORD_KEY(phase), RECORD_KEY(press_force_n), RECORD_KEY(tangential_force_n),
        RECORD_KEY(balance_n), RECORD_KEY(balance_relative), RECORD_KEY(inertia_n), RECORD_KEY(mount_force_n),
        RECORD_KEY(contact_area_mm2), RECORD_KEY(mean_pressure_pa), RECORD_KEY(peak_pressure_pa), RECORD_KEY(sticking),
        RECORD_KEY(slipping), RECORD_KEY(substeps), RECORD_KEY(newton_iterations), RECORD_KEY(patch_iterations),
        RECORD_KEY(lag_iterations), RECORD_KEY(exact_hessian_waits), RECORD_KEY(approximated_share),
        RECORD_KEY(friction_residual_n), RECORD_KEY(velocity_residual_m_s), RECORD_KEY(force_residual_n),
        RECORD_KEY(barrier_stiffness), RECORD_KEY(min_gap_m), RECORD_KEY(stand_off_m), RECORD_KEY(min_volume_ratio),
        RECORD_KEY(intersections), RECORD_KEY(inverted_tets), RECORD_KEY(gel_in_object), RECORD_KEY(pose_error_m),
        RECORD_KEY(body_strain), RECORD_KEY(body_load_n), RECORD_KEY(body_residual_n), RECORD_KEY(body_residual_n_m));
  }
};

/// Summary of a press, of one finger of a grasp, or of one gel of a scene.
/// Counts and extremes are over all frames unless noted.
struct PressSummary {
  std::size_t frames = 0, gel_vertices = 0;
  std::optional<std::string> face = {};  // side of the object that presses
  double d_hat_m = 0.0, barrier_stiffness = 0.0;
  std::string element = {};
  double friction_coefficient = 0.0;
  int newton_iterations = 0;
  double press_force_n = 0.0, tangential_force_n = 0.0;  // forces in the last frame
  int contact_frames = 0;                                // number of frames in which anything touches the gel
  std::optional<double> min_distance_m = {};             // absent if nothing was ever near
  double stand_off_m = 0.0, min_volume_ratio = 0.0;
  int intersections = 0, inverted_tets = 0;
  double max_balance_relative = 0.0, max_pose_error_m = 0.0;
  std::optional<double> object_mass_kg = {}, first_slip_time_s = {}, gross_slip_time_s = {};
  std::optional<std::size_t> press_end_frame = {};
  bool converged = false;
  std::string verdict = {};
  std::optional<std::vector<int>> approximated_frames = {};
  PressLimits limits = {};
  std::vector<PressFrameLines> per_frame = {};

  static constexpr auto keys() {
    using Lines = PressSummary;
    return std::tuple(RECORD_KEY(frames), RECORD_KEY(gel_vertices), RECORD_KEY(face), RECORD_KEY(d_hat_m),
                      RECORD_KEY(barrier_stiffness), RECORD_KEY(element), RECORD_KEY(friction_coefficient),
                      RECORD_KEY(newton_iterations), RECORD_KEY(press_force_n), RECORD_KEY(tangential_force_n),
                      RECORD_KEY(contact_frames), RECORD_KEY(min_distance_m), RECORD_KEY(stand_off_m),
                      RECORD_KEY(min_volume_ratio), RECORD_KEY(intersections), RECORD_KEY(inverted_tets),
                      RECORD_KEY(max_balance_relative), RECORD_KEY(max_pose_error_m), RECORD_KEY(object_mass_kg),
                      RECORD_KEY(first_slip_time_s), RECORD_KEY(gross_slip_time_s), RECORD_KEY(press_end_frame),
                      RECORD_KEY(converged), RECORD_KEY(verdict), RECORD_KEY(approximated_frames), RECORD_KEY(limits),
                      RECORD_KEY(per_frame));
  }
};

/// Pose of the gripped object.
struct HeldPoseLines {
  std::array<double, 4> rotation_xyzw{};  // rotation of world_from_object
  Vector3 grip_m = Vector3::Zero();       // grip point relative to the centre of mass, in the object's axes
  double lever_m = 0.0;                   // distance of the centre of mass from the grip line
  // distance of the contact points and width of the patch; only for a drawn grasp
  std::optional<double> width_m = {}, patch_m = {};

  static constexpr auto keys() {
    using Lines = HeldPoseLines;
    return std::tuple(RECORD_KEY(rotation_xyzw), RECORD_KEY(grip_m), RECORD_KEY(lever_m), RECORD_KEY(width_m),
                      RECORD_KEY(patch_m));
  }
};

/// Times at which one finger slips; absent if it never does.
struct SlipLines {
  std::optional<double> first_slip_s = {}, gross_slip_s = {};

  static constexpr auto keys() {
    using Lines = SlipLines;
    return std::tuple(RECORD_KEY(first_slip_s), RECORD_KEY(gross_slip_s));
  }
};

/// One frame of a grasp.
struct GraspFrameLines {
  double time_s = 0.0;
  std::string phase = {};
  double grip_left_n = 0.0, grip_right_n = 0.0, carried_n = 0.0, height_m = 0.0, hand_height_m = 0.0;
  double slip_m = 0.0, turn_rad = 0.0;  // motion of the object in the hand
  double slip_share_left = 0.0, slip_share_right = 0.0, friction_radius_left_m = 0.0, friction_radius_right_m = 0.0;
  double body_strain = 0.0, body_load_n = 0.0, body_residual_n = 0.0;
  double momentum_residual_n = 0.0, angular_residual_n_m = 0.0;
  double grip_imbalance = 0.0;  // largest imbalance of a drive after a time step, as a fraction of its force
  std::optional<double> friction_use = {};

  static constexpr auto keys() {
    using Lines = GraspFrameLines;
    return std::tuple(RECORD_KEY(time_s), RECORD_KEY(phase), RECORD_KEY(grip_left_n), RECORD_KEY(grip_right_n),
                      RECORD_KEY(carried_n), RECORD_KEY(height_m), RECORD_KEY(hand_height_m), RECORD_KEY(slip_m),
                      RECORD_KEY(turn_rad), RECORD_KEY(slip_share_left), RECORD_KEY(slip_share_right),
                      RECORD_KEY(friction_radius_left_m), RECORD_KEY(friction_radius_right_m), RECORD_KEY(body_strain),
                      RECORD_KEY(body_load_n), RECORD_KEY(body_residual_n), RECORD_KEY(momentum_residual_n),
                      RECORD_KEY(angular_residual_n_m), RECORD_KEY(grip_imbalance), RECORD_KEY(friction_use));
  }
};

/// Summary of a grasp.
struct GraspSummary {
  std::size_t frames = 0;
  std::string outcome = {};
  std::optional<std::string> reason = {};  // absent if lifted
  std::size_t freed_frame = 0, judged_frame = 0;
  double object_mass_kg = 0.0, friction_coefficient = 0.0;
  Vector3 gravity_m_s2 = Vector3::Zero();
  Vector3 center_of_mass_m = Vector3::Zero(), center_of_mass_shift_m = Vector3::Zero();  // object's axes
  HeldPoseLines pose = {};
  double grip_n = 0.0;
  double slip_m = 0.0, turn_rad = 0.0, creep_m = 0.0, creep_rad = 0.0;  // judged frame; slip and turn include creep
  double rise_m = 0.0, hand_rise_m = 0.0;                               // values in the judged frame
  double slip_speed_m_s = 0.0;                                          // ε_v: slower contacts stick, and creep
  double max_momentum_residual_n = 0.0;
  std::optional<SlipLines> slip_left = {}, slip_right = {};
  std::optional<double> friction_margin = {};  // largest friction force of both fingers over the weight
  bool converged = false;
  std::string verdict = {};
  std::vector<GraspFrameLines> per_frame = {};

  static constexpr auto keys() {
    using Lines = GraspSummary;
    return std::tuple(RECORD_KEY(frames), RECORD_KEY(outcome), RECORD_KEY(reason), RECORD_KEY(freed_frame),
                      RECORD_KEY(judged_frame), RECORD_KEY(object_mass_kg), RECORD_KEY(friction_coefficient),
                      RECORD_KEY(gravity_m_s2), RECORD_KEY(center_of_mass_m), RECORD_KEY(center_of_mass_shift_m),
                      RECORD_KEY(pose), RECORD_KEY(grip_n), RECORD_KEY(slip_m), RECORD_KEY(turn_rad),
                      RECORD_KEY(creep_m), RECORD_KEY(creep_rad), RECORD_KEY(rise_m), RECORD_KEY(hand_rise_m),
                      RECORD_KEY(slip_speed_m_s), RECORD_KEY(max_momentum_residual_n), RECORD_KEY(slip_left),
                      RECORD_KEY(slip_right), RECORD_KEY(friction_margin), RECORD_KEY(converged), RECORD_KEY(verdict),
                      RECORD_KEY(per_frame));
  }
};

/// Contact settings of two bodies that a scene file names.
struct ContactLines {
  std::array<std::string, 2> between{};
  double friction = 0.0, d_hat_m = 0.0;

  static constexpr auto keys() {
    using Lines = ContactLines;
    return std::tuple(RECORD_KEY(between), RECORD_KEY(friction), RECORD_KEY(d_hat_m));
  }
};

/// One body of a scene.
struct SceneBodyLines {
  std::string name = {}, kind = {};
  std::optional<double> metres_per_unit = {}, mass_kg = {};

  static constexpr auto keys() {
    using Lines = SceneBodyLines;
    return std::tuple(RECORD_KEY(name), RECORD_KEY(kind), RECORD_KEY(metres_per_unit), RECORD_KEY(mass_kg));
  }
};

/// A rigid body that the gels of a scene hold; see common/sample/scene_hold.h.
struct HeldBodyLines {
  std::string body = {};
  std::optional<std::string> outcome = {};
  std::size_t freed_frame = 0;
  double slip_m = 0.0, turn_rad = 0.0;
  std::optional<double> creep_m = {}, creep_rad = {};  // part of slip_m and turn_rad
  double rise_m = 0.0, hand_rise_m = 0.0;

  static constexpr auto keys() {
    using Lines = HeldBodyLines;
    return std::tuple(RECORD_KEY(body), RECORD_KEY(outcome), RECORD_KEY(freed_frame), RECORD_KEY(slip_m),
                      RECORD_KEY(turn_rad), RECORD_KEY(creep_m), RECORD_KEY(creep_rad), RECORD_KEY(rise_m),
                      RECORD_KEY(hand_rise_m));
  }
};

/// One frame of a scene.
struct SceneFrameLines {
  double time_s = 0.0;
  int phase = 0;  // index of the phase, from 0; −1 in frame 0
  int time_steps = 0, newton_iterations = 0;
  double velocity_residual_m_s = 0.0, force_residual_n = 0.0, body_residual_n = 0.0, body_load_n = 0.0;
  std::optional<double> min_gap_m = {};  // absent if no two bodies are near
  int intersections = 0;

  static constexpr auto keys() {
    using Lines = SceneFrameLines;
    return std::tuple(RECORD_KEY(time_s), RECORD_KEY(phase), RECORD_KEY(time_steps), RECORD_KEY(newton_iterations),
                      RECORD_KEY(velocity_residual_m_s), RECORD_KEY(force_residual_n), RECORD_KEY(body_residual_n),
                      RECORD_KEY(body_load_n), RECORD_KEY(min_gap_m), RECORD_KEY(intersections));
  }
};

/// Summary of a scene.
struct SceneSummary {
  std::size_t frames = 0;
  std::vector<SceneBodyLines> bodies = {};  // ordered as the arrays
  std::vector<ContactLines> contact = {};
  std::vector<std::string> untouched_gels = {};  // gels that nothing ever touches
  std::optional<double> min_distance_m = {};     // absent if no two bodies were ever near
  int intersections = 0;
  double body_strain = 0.0, max_body_balance_relative = 0.0, max_momentum_residual_n = 0.0;
  std::vector<HeldBodyLines> held = {};
  bool converged = false;
  std::string verdict = {};
  std::vector<SceneFrameLines> per_frame = {};

  static constexpr auto keys() {
    using Lines = SceneSummary;
    return std::tuple(RECORD_KEY(frames), RECORD_KEY(bodies), RECORD_KEY(contact), RECORD_KEY(untouched_gels),
                      RECORD_KEY(min_distance_m), RECORD_KEY(intersections), RECORD_KEY(body_strain),
                      RECORD_KEY(max_body_balance_relative), RECORD_KEY(max_momentum_residual_n), RECORD_KEY(held),
                      RECORD_KEY(converged), RECORD_KEY(verdict), RECORD_KEY(per_frame));
  }
};

/// Verdict of a record whose frames all passed. Records with another verdict are not written.
inline constexpr const char* kPassed = "pass";

}  // namespace tacipc
