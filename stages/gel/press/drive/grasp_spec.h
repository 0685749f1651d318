// Sample file of a grasp: two sensors that close on a free object, and the motion that follows.
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

/// Motion of the fingers in one phase. Phases after a `close` keep its grip force or its width.
struct GraspPhase {
  PhaseKind kind = PhaseKind::close;   // approach, close, lift, hold, shake, turn or release
  int steps = 0;                       // number of frames
  int substeps = 1;                    // number of time steps per frame
  double force_n = 0.0;                // close: mean grip force of both fingers at the end
  std::optional<double> width_m = {};  // close: distance of the fronts' planes at the end, instead of a force
  double gap_m = 0.0;         // approach: distance of each front's plane from the object, before the first close
  double distance_m = 0.0;    // lift: displacement upwards; release: displacement of each finger outwards
  double amplitude_m = 0.0;   // shake: amplitude from the initial position
  double frequency_hz = 0.0;  // shake: frequency
  int axis = 2;               // axis in the world; shake: y or z; turn: x, y or z
  double angle_rad = 0.0;     // turn: rotation of the hand about the grip point

  static GraspPhase read(ConfigReader& in);
};

/// Specification of a grasp. Two sensors of one kind face each other along x of the world; z is up. The object hangs
/// between them: it is held until the end of the first `close`, and free afterwards.
struct GraspSpec {
  std::optional<double> mass_kg;                    // mass of the object; one of mass, margin and density is given
  std::optional<double> friction_margin;            // 2 μ × force of the first `close` / weight
  double density_kg_m3 = 0.0;                       // density of the object
  std::optional<double> friction_coefficient = {};  // friction of gels and object; absent: from the press file
  /// Offset of the centre of mass from that of the solid, in the object's axes.
  Vector3 center_shift_m = Vector3::Zero();
  std::optional<GraspDraw> draw;  // random draw of the grasp; absent: the following three give it
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // rotation of the object before it is gripped
  double turn_rad = 0.0;                                         // subsequent rotation about z of the world
  Vector3 grip_m = Vector3::Zero();          // grip point, from the solid's centre, in the object's axes
  Vector3 gravity_m_s2 = {0.0, 0.0, -9.81};  // gravity in the world
  double closing_speed_m_s = 0.02;           // largest speed of each finger
  DriveInertia mount = {};                   // inertia of a finger along its closing axis
  bool drive_each = false;  // each finger has its own drive; false: one drive closes both by equal displacements
  std::optional<double> start_gap_m = {};  // gap of each finger in frame 0; absent: from the press file
  std::vector<GraspPhase> motion;

  static GraspSpec read(ConfigReader& in);
  /// Press configuration with the friction of this object. \throw UsageError if the press file has no friction
  PressConfig pressed_with(const PressConfig& config) const;
  /// Mass properties of the object as it is held.
  /// \throw DataError if its centre of mass would lie outside of its bounding box
  MassProperties mass_of(const TriangleMesh& object) const;
  /// Pose in which the object is gripped by fronts of this shape.
  /// \param mass mass_of(object)
  /// \throw DataError if none of the drawn grasps is possible
  GraspPose pose_of(const TriangleMesh& object, const MassProperties& mass, const GelShape& front,
                    double friction) const;
  /// Density of an object of this volume. \throw UsageError if a friction margin is given without friction
  double density_of(double volume_m3, double friction) const;
};

}  // namespace tacipc
