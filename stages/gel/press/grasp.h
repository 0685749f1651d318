// A grasp: two gels on their mounts, and an object between them that is free once they have closed on it.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stages/gel/press/grasp_spec.h"
#include "stages/gel/press/measure/conservation.h"
#include "stages/gel/press/simulate.h"

namespace tacipc {

/// Of a finger, along the axis by which it closes.
struct FingerDrive {
  double force_n = 0.0;  // that its drive closes with; where fingers go by a way, their grip
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
  double body_residual_n = 0.0, body_load_n = 0.0;
  double slip_m = 0.0;    // of the object's point at the grip, in the hand, since the fingers closed
  double turn_rad = 0.0;  // of the object in the hand since then
  WholeAccount whole;     // of gels and object; the residuals are those of the frame's time steps

  /// How hard a finger presses: |contact force along its z|.
  double grip_n(std::size_t side) const;
};

/// What became of the object, by its motion in the hand and by contact alone; docs/grasp.md.
enum class GraspOutcome { lifted, slipped, rotated, dropped };
inline constexpr std::array kGraspOutcomes{"lifted", "slipped", "rotated", "dropped"};

struct Grasp {
  std::array<Simulation, 2> fingers;  // left, right: each as a press of its own, in its own frame S
  std::vector<GraspFrame> frames;
  double mass_kg = 0.0, weight_n = 0.0;
  Vector3 center_of_mass_m = Vector3::Zero();  // in the object's axes
  GraspPose pose;                              // in which it is gripped
  double grip_n = 0.0;                         // mean of both fingers when they have closed
  GraspOutcome outcome = GraspOutcome::lifted;
  std::size_t freed_frame = 0;   // the last one of the first `close`
  std::size_t judged_frame = 0;  // the last one before the fingers release it: what the outcome is of
};

/// Keeps bytes of frames in order, so that an interrupted run resumes.
class ByteStore {
 public:
  virtual ~ByteStore() = default;
  virtual void save(const std::string& bytes) = 0;
  virtual std::optional<std::string> load() = 0;
};

/// \throw as simulate()
Grasp grasp(const Sensor& sensor, const TetMesh& gel, const TriangleMesh& object, const PressConfig& config,
            const GraspSpec& spec, const ProgressObserver& observe, ByteStore* store = nullptr);

}  // namespace tacipc
