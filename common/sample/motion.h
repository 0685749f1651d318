// The motion of one sample: phases, each of which moves the object by a rule or lets it yield to a load.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"

namespace tacipc {

/// What a phase does, the last four of a grasp. The numbers stand in phase.npy; `reference` and `approach` name
/// frames, not phases.
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

inline constexpr std::array kPhaseNames{"reference", "approach", "press", "shear", "twist", "hold",  "release", "tilt",
                                        "path",      "load",     "free",  "close", "lift",  "shake", "turn"};

const char* name_of(PhaseKind kind);

/// One row of a path: a rigid motion of the object at a time.
struct PathPoint {
  double time_s = 0.0;
  Vector3 shift_m = Vector3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Rows t,x,y,z,qx,qy,qz,qw (s, m, unit quaternion, scalar last; a first row of names is allowed), times ascending
/// from 0. \throw DataError naming the line.
std::vector<PathPoint> read_path(const std::filesystem::path& file);

/// Degrees that a motion or placement may turn by: a hundred turns, beyond which is a slip of the pen.
inline const Range kAnyTurn = Range::between(-36000.0, 36000.0);

struct Phase {
  PhaseKind kind = PhaseKind::press;
  int steps = 0;                        // frames
  int substeps = 1;                     // time steps per frame
  double depth_m = 0.0;                 // press: of the object's lowest point below z = 0 at the end …
  Vector3 shift_m = Vector3::Zero();    // shear: of the whole phase
  double angle_rad = 0.0;               // twist, tilt
  double direction_rad = 0.0;           // tilt: the object's top leans towards this direction, from x towards y
  std::optional<double> height_m = {};  // release: of the lowest point at the end; absent: as in frame 0
  std::optional<Vector3> load_n = {};   // press … or with this force on the object instead of a depth; load; free
  std::array<bool, 3> free = {};        // axes of S along which the object yields to the load
  std::filesystem::path file = {};      // path
  bool absolute = false;  // path: rows are gel_from_object, else motions about the placed object's reference point
  std::vector<PathPoint> points = {};  // path, read from the file

  static Phase read(ConfigReader& in);
};

/// Where the object should be at the end of a time step, and the axes along which it may yield.
struct Goal {
  Matrix4 gel_from_object = Matrix4::Identity();  // along free axes: where it would be without yielding in this phase
  std::array<bool, 3> free = {};
  Vector3 load_n = Vector3::Zero();  // on the object, along its free axes
  double duration_s = 0.0;
};

/// A phase under way.
struct PhaseStart {
  Matrix4 gel_from_object;  // at the start of the phase
  Matrix4 placed;           // in frame 0
  Vector3 reference_m;      // the object's reference point in the object frame: below the centre of its bounding box as
                            // placed, at its lowest height
  double lowest_z_m = 0.0;  // of the object at the start of the phase
  double start_z_m = 0.0;   // of the object in frame 0
  std::array<bool, 3> free = {};
  Vector3 load_n = Vector3::Zero();
};

/// Goal `step` time steps into a phase (whole numbers are their ends); each lasts `time_step_s` (a path's rows say how
/// long theirs do).
Goal goal_of(const Phase& phase, double step, const PhaseStart& start, double time_step_s);

/// Time steps of a phase.
int time_steps(const Phase& phase);

}  // namespace tacipc
