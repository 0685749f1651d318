// Frames and labels of a grasp.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "common/sample/grasp_outcome.h"
#include "stages/gel/press/drive/grasp_spec.h"
#include "stages/gel/press/measure/conservation.h"
#include "stages/gel/press/world/frame.h"

namespace tacipc {

/// Force by which a finger presses, N: |contact force along its z axis|.
inline double pressing_n(const Vector3& force_n, const Matrix4& world_from_finger) {
  return std::abs(force_n.dot(world_from_finger.col(2).head<3>()));
}

/// Drive of a finger, along its closing axis.
struct FingerDrive {
  double force_n = 0.0;  // force of the drive; of a finger with a prescribed displacement, its grip force
  double closed_m = 0.0, velocity_m_s = 0.0;
};

/// One instant of a grasp, in the world: in frame 0 x points from the left finger to the right, z up.
struct GraspFrame {
  double time_s = 0.0;
  PhaseKind phase = PhaseKind::reference;
  Matrix4 world_from_hand = Matrix4::Identity();  // origin: grip point of the object in frame 0
  std::array<Matrix4, 2> world_from_finger;
  std::array<Vector3, 2> force_on_finger_n = {Vector3::Zero(),
                                              Vector3::Zero()};  // contact force by the object and the other gel
  std::array<FingerDrive, 2> drives = {};
  Matrix4 world_from_object;
  Vector3 velocity_m_s = Vector3::Zero(), spin_rad_s = Vector3::Zero();
  double grip_imbalance = 0.0;  // largest imbalance of a drive in the frame's time steps, as a fraction of its force
  double slip_m = 0.0;          // displacement of the object's grip point in the hand since the fingers closed
  double turn_rad = 0.0;        // rotation of the object in the hand since then
  // Slip and rotation without creep, and creep; computed once all frames are there.
  double slid_m = 0.0, slid_rad = 0.0, creep_m = 0.0, creep_rad = 0.0;
  WholeAccount whole;  // energy and momentum of gels and object; residuals are those of the frame's time steps

  /// Force by which a finger presses, N.
  double grip_n(std::size_t side) const { return pressing_n(force_on_finger_n[side], world_from_finger[side]); }
};

/// Contact of a finger in one frame.
struct FingerContact {
  double slip_share = 0.0;         // fraction of the front's normal force on vertices that slip
  double friction_radius_m = 0.0;  // mean distance of the normal force from its centre, in the plane of the front
};

/// Times at which the contact of a finger began to slip, partially and as a whole; docs/grasp.md.
struct SlipTimes {
  std::optional<double> first_s, gross_s;
};

/// Reason why the object was not held, by comparison with the largest possible friction; docs/grasp.md.
enum class GraspReason { no_contact, weight, acceleration, torque, uneven_grip, other };
inline constexpr std::array kGraspReasons{"no_contact", "weight", "acceleration", "torque", "uneven_grip", "other"};

/// A finished grasp: both fingers, all frames and its labels.
struct Grasp {
  std::array<Simulation, 2> fingers;  // left, right: each as a press run of its own, in its own frame S
  std::vector<GraspFrame> frames;
  double mass_kg = 0.0, weight_n = 0.0, friction = 0.0;
  double slip_speed_m_s = 0.0;  // ε_v: slower contacts stick
  Vector3 gravity_m_s2 = Vector3::Zero();
  Vector3 center_of_mass_m = Vector3::Zero(), center_shift_m = Vector3::Zero();  // both in the object's axes
  GraspPose pose;                                                                // pose in which the object is gripped
  double grip_n = 0.0;  // mean grip force of both fingers after closing, N
  GraspOutcome outcome = GraspOutcome::lifted;
  std::optional<GraspReason> reason;                   // reason of an outcome other than `lifted`
  std::vector<std::array<FingerContact, 2>> contacts;  // contact of both fingers, per frame
  /// Required over possible friction, per frame from freed_frame on while the object is held.
  std::vector<double> friction_use;
  std::array<SlipTimes, 2> slips;
  std::size_t freed_frame = 0;   // last frame of the first `close` phase
  std::size_t judged_frame = 0;  // last frame before the fingers release the object; the outcome is judged there

  /// Point at which the object is gripped, in its own axes.
  Vector3 grip_point() const { return center_of_mass_m + pose.grip_m; }
};

}  // namespace tacipc
