#include "common/sample/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {
namespace {

constexpr int kMaxSteps = 100000;
/// Kinds that a motion file may contain. Press and grasp runs add phases of their own.
const std::vector<std::string> kKinds(kPhaseNames.begin() + static_cast<int>(PhaseKind::press),
                                      kPhaseNames.begin() + static_cast<int>(PhaseKind::free) + 1);

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

Matrix4 shifted(const Matrix4& pose, const Vector3& shift) {
  Matrix4 out = pose;
  out.topRightCorner<3, 1>() += shift;
  return out;
}

/// Rotates a pose about a point of S.
Matrix4 turned(const Matrix4& pose, const Matrix3& rotation, const Vector3& about) {
  Matrix4 out = pose;
  out.topLeftCorner<3, 3>() = rotation * pose.topLeftCorner<3, 3>();
  out.topRightCorner<3, 1>() = about + rotation * (pose.topRightCorner<3, 1>() - about);
  return out;
}

/// Sets the load at the end of a phase, and the free axes. Unstated values are those of the previous phase.
void yielding(const Phase& phase, const PhaseStart& start, double part, Goal& goal) {
  goal.free = start.free;
  goal.load_n = start.load_n;
  switch (phase.kind) {
    case PhaseKind::release: goal.free = {}; break;
    case PhaseKind::press: goal.free = {false, false, phase.load_n.has_value()}; break;
    case PhaseKind::load: goal.free = phase.free; break;
    case PhaseKind::free:  // no axis is driven, and the force is not gradual: the object is released at once
      goal.free = {};
      goal.load_n = *phase.load_n;
      return;
    case PhaseKind::shear:
    case PhaseKind::path: goal.free[0] = goal.free[1] = false; break;
    default: break;
  }
  if (phase.load_n) goal.load_n = start.load_n + part * (*phase.load_n - start.load_n);
  for (int axis = 0; axis < 3; ++axis) {
    if (!goal.free[axis]) goal.load_n[axis] = 0.0;
  }
}

}  // namespace

const char* name_of(PhaseKind kind) { return kPhaseNames[static_cast<std::size_t>(kind)]; }

std::vector<PathPoint> read_path(const std::filesystem::path& file) {
  std::istringstream text(read_file(file));
  std::vector<PathPoint> points;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    double v[8];
    int count = 0;
    std::string cell;
    std::istringstream cells(line);
    bool numeric = true;
    while (std::getline(cells, cell, ',')) {
      const auto last = cell.find_last_not_of(" \t\r");
      cell = last == std::string::npos ? "" : cell.substr(0, last + 1);
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      numeric = numeric && end != cell.c_str() && *end == '\0' && std::isfinite(value);
      if (count < 8) v[count] = value;
      ++count;
    }
    if (!numeric && points.empty() && number == 1) continue;  // a heading
    if (!numeric || count != 8)
      throw DataError("{}:{}: expected the eight numbers t,x,y,z,qx,qy,qz,qw", file.string(), number);
    const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
    if (std::abs(q.norm() - 1.0) > 1e-3)
      throw DataError("{}:{}: the quaternion has length {:.6g}, expected 1", file.string(), number, q.norm());
    if (points.empty() ? v[0] != 0.0 : v[0] <= points.back().time_s)
      throw DataError("{}:{}: times must start at 0 and ascend", file.string(), number);
    points.push_back({v[0], {v[1], v[2], v[3]}, q.normalized()});
  }
  if (points.size() < 2) throw DataError("{}: a path needs at least two rows", file.string());
  return points;
}

Phase Phase::read(ConfigReader& in) {
  Phase phase;
  const std::string kind = in.choice("kind", kKinds);
  phase.kind = static_cast<PhaseKind>(std::ranges::find(kPhaseNames, kind) - kPhaseNames.begin());
  switch (phase.kind) {
    case PhaseKind::press:
      if (in.has("force_n")) {
        if (in.has("depth_mm")) in.fault("force_n", "a press has a depth_mm or a force_n, not both");
        phase.load_n = Vector3(0.0, 0.0, -in.number("force_n", Range::positive()));
        phase.free = {false, false, true};
        if (in.has("depth_mm")) in.ignore("depth_mm");
      } else {
        phase.depth_m = 1e-3 * in.number("depth_mm", Range::positive());
      }
      break;
    case PhaseKind::shear: {
      const double distance_m = 1e-3 * in.number("distance_mm", Range::positive());
      const double direction = radians(in.number_or("direction_deg", 0.0, kAnyTurn));
      phase.shift_m = {distance_m * std::cos(direction), distance_m * std::sin(direction), 0.0};
      break;
    }
    case PhaseKind::twist: phase.angle_rad = radians(in.number("angle_deg", kAnyTurn)); break;
    case PhaseKind::tilt:
      phase.angle_rad = radians(in.number("angle_deg", Range::between(-89.0, 89.0)));
      phase.direction_rad = radians(in.number_or("direction_deg", 0.0, kAnyTurn));
      break;
    case PhaseKind::release:
      if (const auto height = in.optional_number("height_mm")) phase.height_m = 1e-3 * *height;
      break;
    case PhaseKind::load: {
      phase.load_n = in.vector3("force_n");
      const std::string axes = in.text_or("free", "xyz");
      for (const char axis : axes) {
        if (axis < 'x' || axis > 'z') {
          in.fault("free", "'" + axes + "' is not made of the letters x, y, z");
          break;
        }
        phase.free[static_cast<std::size_t>(axis - 'x')] = true;
      }
      break;
    }
    case PhaseKind::free: phase.load_n = in.has("force_n") ? in.vector3("force_n") : Vector3::Zero(); break;
    case PhaseKind::path: {
      phase.file = std::filesystem::path(in.source()).parent_path() / in.text("file");
      phase.absolute = in.choice_or("relative_to", "placement", {"placement", "sensor"}) == "sensor";
      if (in.has("file")) {
        phase.points = read_path(phase.file);
        phase.steps = static_cast<int>(phase.points.size()) - 1;
      }
      phase.substeps = in.integer_or("substeps", 1, 1, 1000);
      return phase;
    }
    default: break;
  }
  phase.steps = in.integer("steps", 1, kMaxSteps);
  phase.substeps = in.integer_or("substeps", 1, 1, 1000);
  return phase;
}

int time_steps(const Phase& phase) { return phase.steps * phase.substeps; }

Goal goal_of(const Phase& phase, double step, const PhaseStart& start, double time_step_s) {
  const double part = step / time_steps(phase);
  const Vector3 reference =
      start.gel_from_object.topLeftCorner<3, 3>() * start.reference_m + start.gel_from_object.topRightCorner<3, 1>();
  Goal goal;
  goal.duration_s = time_step_s;
  goal.gel_from_object = start.gel_from_object;
  yielding(phase, start, part, goal);
  const auto raise_to = [&](double z) {
    goal.gel_from_object = shifted(start.gel_from_object, {0.0, 0.0, part * (z - start.lowest_z_m)});
  };
  switch (phase.kind) {
    case PhaseKind::press:
      if (!phase.load_n) raise_to(-phase.depth_m);
      break;
    case PhaseKind::release: raise_to(phase.height_m.value_or(start.start_z_m)); break;
    case PhaseKind::shear: goal.gel_from_object = shifted(start.gel_from_object, part * phase.shift_m); break;
    case PhaseKind::twist:
      goal.gel_from_object =
          turned(start.gel_from_object, Eigen::AngleAxisd(part * phase.angle_rad, Vector3::UnitZ()).toRotationMatrix(),
                 reference);
      break;
    case PhaseKind::tilt: {
      const Vector3 axis(-std::sin(phase.direction_rad), std::cos(phase.direction_rad), 0.0);
      goal.gel_from_object =
          turned(start.gel_from_object, Eigen::AngleAxisd(part * phase.angle_rad, axis).toRotationMatrix(), reference);
      break;
    }
    case PhaseKind::path: {
      const double rows = step / phase.substeps;
      const double row = std::clamp(std::ceil(rows) - 1.0, 0.0, static_cast<double>(phase.points.size()) - 2.0);
      const double within = rows - row;
      const PathPoint &a = phase.points[static_cast<std::size_t>(row)],
                      &b = phase.points[static_cast<std::size_t>(row) + 1];
      goal.duration_s = (b.time_s - a.time_s) / phase.substeps;
      const Vector3 shift = a.shift_m + within * (b.shift_m - a.shift_m);
      const Matrix3 rotation = a.rotation.slerp(within, b.rotation).normalized().toRotationMatrix();
      if (phase.absolute) {
        goal.gel_from_object.topLeftCorner<3, 3>() = rotation;
        goal.gel_from_object.topRightCorner<3, 1>() = shift;
      } else {
        const Vector3 about =
            start.placed.topLeftCorner<3, 3>() * start.reference_m + start.placed.topRightCorner<3, 1>();
        goal.gel_from_object = shifted(turned(start.placed, rotation, about), shift);
      }
      break;
    }
    default: break;
  }
  return goal;
}

}  // namespace tacipc
