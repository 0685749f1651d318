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

/// Force by which a finger presses: |contact force along its z|.
inline double pressing_n(const Vector3& force_n, const Matrix4& world_from_finger) {
  return std::abs(force_n.dot(world_from_finger.col(2).head<3>()));
}

/// Drive of a finger, along the axis by which it closes.
struct FingerDrive {
  double force_n = 0.0;  // force of the drive; of a finger that is moved by a displacement, its grip
  double closed_m = 0.0, velocity_m_s = 0.0;
};

/// One instant of a grasp, in the world: in frame 0 x is from the left finger to the right, z is up.
struct GraspFrame {
  double time_s = 0.0;
  PhaseKind phase = PhaseKind::reference;
  Matrix4 world_from_hand = Matrix4::Identity();  // its origin is where the object is gripped in frame 0
  std::array<Matrix4, 2> world_from_finger;
  std::array<Vector3, 2> force_on_finger_n = {Vector3::Zero(), Vector3::Zero()};  // by the object and by the other gel
  std::array<FingerDrive, 2> drives = {};
  Matrix4 world_from_object;
  Vector3 velocity_m_s = Vector3::Zero(), spin_rad_s = Vector3::Zero();
  double grip_imbalance = 0.0;  // largest fraction of the force missing to a drive's balance in the frame's time steps
  double slip_m = 0.0;          // of the object's point at the grip, in the hand, since the fingers closed
  double turn_rad = 0.0;        // of the object in the hand since then
  // The same without creep, and the creep; known once all frames are there.
  double slid_m = 0.0, slid_rad = 0.0, creep_m = 0.0, creep_rad = 0.0;
  WholeAccount whole;  // of gels and object; the residuals are those of the frame's time steps

  /// Force by which a finger presses.
  double grip_n(std::size_t side) const { return pressing_n(force_on_finger_n[side], world_from_finger[side]); }
};

/// Contact of a finger with the object in one frame.
struct FingerContact {
  double slip_share = 0.0;         // of the normal force on the front: how much is on vertices that slip
  double friction_radius_m = 0.0;  // mean distance of the normal force from its centre, in the plane of the front
};

/// When the contact of a finger began to slip; docs/grasp.md.
struct SlipTimes {
  std::optional<double> first_s, gross_s;
};

/// Why it was not held, by what friction could bear; docs/grasp.md.
enum class GraspReason { no_contact, weight, acceleration, torque, uneven_grip, other };
inline constexpr std::array kGraspReasons{"no_contact", "weight", "acceleration", "torque", "uneven_grip", "other"};

struct Grasp {
  std::array<Simulation, 2> fingers;  // left, right: each as a press of its own, in its own frame S
  std::vector<GraspFrame> frames;
  double mass_kg = 0.0, weight_n = 0.0, friction = 0.0;
  double slip_speed_m_s = 0.0;  // ε_v: slower contacts stick
  Vector3 gravity_m_s2 = Vector3::Zero();
  Vector3 center_of_mass_m = Vector3::Zero(), center_shift_m = Vector3::Zero();  // in the object's axes
  GraspPose pose;                                                                // in which it is gripped
  double grip_n = 0.0;  // mean of both fingers when they have closed
  GraspOutcome outcome = GraspOutcome::lifted;
  std::optional<GraspReason> reason;                   // of any other outcome
  std::vector<std::array<FingerContact, 2>> contacts;  // of each frame
  std::vector<double> friction_use;  // of each frame from the one it was freed in as long as it is held
  std::array<SlipTimes, 2> slips;
  std::size_t freed_frame = 0;   // the last one of the first `close`
  std::size_t judged_frame = 0;  // the last one before the fingers release it: what the outcome is of

  /// Where the object is gripped, in its own axes.
  Vector3 grip_point() const { return center_of_mass_m + pose.grip_m; }
};

}  // namespace tacipc
