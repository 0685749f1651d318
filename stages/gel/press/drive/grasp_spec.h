// The sample file of a grasp: two sensors that close on a free object, and what they do with it.
#pragma once

#include <optional>
#include <vector>

#include "common/config/config.h"
#include "common/mesh/mass_properties.h"
#include "common/sample/antipodal_grasp.h"
#include "common/sample/motion.h"
#include "stages/gel/press/drive/grip_control.h"
#include "stages/gel/press/world/press_config.h"

namespace tacipc {

/// What the fingers do in one phase. They carry on with the grip force or the width of the last `close`.
struct GraspPhase {
  PhaseKind kind = PhaseKind::close;   // approach, close, lift, hold, shake, turn or release
  int steps = 0;                       // frames
  int substeps = 1;                    // time steps per frame
  double force_n = 0.0;                // close: mean of both fingers at the end …
  std::optional<double> width_m = {};  // … or how far the fronts' undeformed planes are apart then
  double gap_m = 0.0;                  // approach: between each of these planes and the object, before the first close
  double distance_m = 0.0;             // lift: upwards; release: of each finger, outwards
  double amplitude_m = 0.0;            // shake: how far it goes from where it began …
  double frequency_hz = 0.0;           // … and so often there and back in a second
  int axis = 2;                        // shake: along y or z of the world; turn: about x, y or z
  double angle_rad = 0.0;              // turn: of the hand, about where the object was gripped

  static GraspPhase read(ConfigReader& in);
};

/// Two sensors of one kind face each other along x of the world, z is up. The object hangs between them, held until the
/// first `close` is over, and free from then on.
struct GraspSpec {
  std::optional<double> mass_kg;          // of the object, or
  std::optional<double> friction_margin;  // 2 μ × force of the first `close` / weight, or
  double density_kg_m3 = 0.0;
  std::optional<double> friction_coefficient = {};  // coefficient between gels and object; absent: the press file's
  Vector3 center_shift_m = Vector3::Zero();         // of its centre of mass from that of the solid, in its own axes
  std::optional<GraspDraw> draw;                    // how it is held is drawn, or given:
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // of the object before it is gripped …
  double turn_rad = 0.0;                                         // … and then about z of the world
  Vector3 grip_m = Vector3::Zero();          // where it is gripped, from the solid's centre, in the object's axes
  Vector3 gravity_m_s2 = {0.0, 0.0, -9.81};  // of the world
  double closing_speed_m_s = 0.02;           // of each finger, at most
  DriveInertia mount = {};                   // of a finger, along the axis by which it closes
  bool drive_each = false;                   // each finger has a drive of its own, else one closes both by the same way
  std::optional<double> start_gap_m = {};    // of each finger in frame 0; absent: as the press file has it
  std::vector<GraspPhase> motion;

  static GraspSpec read(ConfigReader& in);
  /// The press file with the friction of this object. \throw UsageError if the file has none to begin with
  PressConfig pressed_with(const PressConfig& config) const;
  /// Of the object as it is held. \throw DataError if its centre of mass would lie outside of its bounding box
  MassProperties mass_of(const TriangleMesh& object) const;
  /// How the object is held by fronts of this shape. \param mass mass_of(object)
  /// \throw DataError if none of the drawn grasps is possible
  GraspPose pose_of(const TriangleMesh& object, const MassProperties& mass, const GelShape& front,
                    double friction) const;
  /// Density of an object of this volume. \throw UsageError if a margin is wanted of no friction
  double density_of(double volume_m3, double friction) const;
};

}  // namespace tacipc
