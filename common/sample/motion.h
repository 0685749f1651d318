// The motion of one sample: a list of phases, each of which moves the object by a rule or lets it yield to a load.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"

namespace tacipc {

/// Kind of a phase; the last four occur in grasps only. The numbers are stored in phase.npy; `reference` and `approach`
/// name frames, not phases.
enum class PhaseKind {
  reference,
  approach,
  press,
  shear,
  twist,
  hold,
  release,
  tilt,
  path,
  load,
  free,
  close,
  lift,
  shake,
  turn
};

/// Names of the kinds, in the order of the enum.
inline constexpr std::array kPhaseNames{"reference", "approach", "press", "shear", "twist", "hold",  "release", "tilt",
                                        "path",      "load",     "free",  "close", "lift",  "shake", "turn"};

/// Returns the name of a kind.
const char* name_of(PhaseKind kind);

/// One row of a path: a rigid motion of the object at a time.
struct PathPoint {
  double time_s = 0.0;
  Vector3 shift_m = Vector3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Reads rows t,x,y,z,qx,qy,qz,qw (s, m, unit quaternion, scalar last; a heading in the first row is allowed), with
/// times ascending from 0.
/// \throw DataError naming the line
std::vector<PathPoint> read_path(const std::filesystem::path& file);

/// Range of rotations of a motion or placement, degrees: a hundred turns. Larger values are taken for typing errors.
inline const Range kAnyTurn = Range::between(-36000.0, 36000.0);

/// One phase of a motion.
struct Phase {
  PhaseKind kind = PhaseKind::press;
  int steps = 0;                        // frames
  int substeps = 1;                     // time steps per frame
  double depth_m = 0.0;                 // press: depth of the object's lowest point below z = 0 at the end
  Vector3 shift_m = Vector3::Zero();    // shear: displacement over the whole phase
  double angle_rad = 0.0;               // twist, tilt
  double direction_rad = 0.0;           // tilt: direction towards which the object's top leans, from x towards y
  std::optional<double> height_m = {};  // release: height of the lowest point at the end; absent: its height in frame 0
  std::optional<Vector3> load_n = {};   // load, free: force on the object; press: force that replaces the depth
  std::array<bool, 3> free = {};        // axes of S along which the object yields to the load
  std::filesystem::path file = {};      // path
  bool absolute = false;  // path: rows are gel_from_object, not motions about the placed object's reference point
  std::vector<PathPoint> points = {};  // rows of a path's file

  /// Reads a phase, and the file of its path.
  static Phase read(ConfigReader& in);
};

/// Target of a time step: the object's pose at its end, and the axes along which the object may yield.
struct Goal {
  Matrix4 gel_from_object = Matrix4::Identity();  // target; along free axes, the pose without yielding
  std::array<bool, 3> free = {};
  Vector3 load_n = Vector3::Zero();  // force on the object along its free axes
  double duration_s = 0.0;
};

/// State at the start of a phase.
struct PhaseStart {
  Matrix4 gel_from_object;  // pose at the start of the phase
  Matrix4 placed;           // pose in frame 0
  Vector3 reference_m;  // reference point in the object frame: below the centre of the bounding box as placed, at the
                        // box's lowest height
  double lowest_z_m = 0.0;  // height of the object's lowest point at the start of the phase
  double start_z_m = 0.0;   // height of that point in frame 0
  std::array<bool, 3> free = {};
  Vector3 load_n = Vector3::Zero();
};

/// Returns the target after `step` time steps of a phase; fractions of a step are allowed.
/// \param time_step_s duration of a step; a path takes durations from its rows instead
Goal goal_of(const Phase& phase, double step, const PhaseStart& start, double time_step_s);

/// Returns the number of time steps of a phase.
int time_steps(const Phase& phase);

}  // namespace tacipc
