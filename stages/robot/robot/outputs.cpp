#include "stages/robot/robot/outputs.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/format/csv.h"
#include "common/sample/robot_folder.h"
#include "common/sample/scene_folder.h"
#include "common/stage/record.h"
#include "stages/robot/robot/pad_gap.h"
#include "stages/robot/robot/shapes.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEvents = "contacts.csv";

Value::List numbers(const Vector3& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }

Value::List turn_deg(const Matrix4& pose) {
  const Eigen::AngleAxisd turn(Matrix3(pose.topLeftCorner<3, 3>()));
  return numbers(180.0 / std::numbers::pi * turn.angle() * turn.axis());
}

/// Returns the frame after which a body is released.
int held_frames(const TaskSpec& task, const ObjectSpec& object) {
  return static_cast<int>(std::ceil(std::min(1e9, object.held_s / task.frame_s - 1e-9)));
}

std::string scene_text(const fs::path& folder, const TaskSpec& task, const std::vector<TaskObject>& objects,
                       const RobotModel& robot, const std::vector<Matrix4>& object_start, int frames) {
  Value::List bodies;
  for (const PadSpec& pad : task.pads)
    bodies.emplace_back(Value::Map{
        {"name", pad.name}, {"kind", "gel"}, {"path", field_named(field_of(RobotArray::path), pad.name).file}});
  for (std::size_t i = 0; i < task.objects.size(); ++i) {
    const ObjectSpec& spec = task.objects[i];
    Value::Map body{{"name", spec.name},
                    {"kind", spec.fixed ? "fixed" : "rigid"},
                    {"mesh", fs::relative(fs::absolute(spec.mesh), fs::absolute(folder)).string()},
                    {"unit", spec.unit}};
    if (!spec.fixed) body.emplace_back("mass_g", 1e3 * objects[i].mass_kg);
    body.emplace_back("at_mm", numbers(1e3 * object_start[i].topRightCorner<3, 1>()));
    body.emplace_back("turn_deg", turn_deg(object_start[i]));
    bodies.emplace_back(std::move(body));
  }
  Value::List contact;
  for (const TouchSpec& touch : task.contact) {
    Value::Map pair{{"between", Value::List(touch.between.begin(), touch.between.end())}};
    if (touch.friction) pair.emplace_back("friction", *touch.friction);
    if (touch.d_hat_mm) pair.emplace_back("d_hat_mm", *touch.d_hat_mm);
    contact.emplace_back(std::move(pair));
  }
  std::set<int> ends{frames};
  for (const ObjectSpec& object : task.objects) ends.insert(std::min(frames, held_frames(task, object)));
  Value::List motion;
  int from = 0;
  for (const int end : ends) {
    if (end == from) continue;
    Value::Map phase{{"steps", end - from}};
    Value::List held;
    for (const ObjectSpec& object : task.objects) {
      if (!object.fixed && held_frames(task, object) > from) held.emplace_back(object.name);
    }
    if (!held.empty()) phase.emplace_back("hold", std::move(held));
    motion.emplace_back(std::move(phase));
    from = end;
  }
  const mjtNum* g = robot.model().opt.gravity;
  const bool weightless = (robot.model().opt.disableflags & mjDSBL_GRAVITY) != 0;
  Value::Map scene{{"time_step_s", task.frame_s},
                   {"gravity_m_s2", weightless ? numbers(Vector3::Zero()) : numbers({g[0], g[1], g[2]})},
                   {"bodies", std::move(bodies)}};
  if (!contact.empty()) scene.emplace_back("contact", std::move(contact));
  scene.emplace_back("motion", std::move(motion));
  return to_yaml(scene);
}

// Gap if no surface is within a metre: a finite number can be stored and interpolated.
constexpr double kNowhere_m = 1.0;

/// Returns the gap between a pad and one object.
double gap_to(const TaskSpec& task, const std::vector<TaskObject>& objects, std::size_t pad,
              const Matrix4& world_from_gel, std::size_t object, const Matrix4& object_pose) {
  return gap_before(objects[object].mesh, world_from_gel.inverse() * object_pose, task.pads[pad].radius_m);
}

}  // namespace

void write_outputs(Stage& stage, const TaskSpec& task, const std::vector<TaskObject>& objects, const RobotModel& robot,
                   const std::vector<Matrix4>& object_start, const RobotRun& run, const WindowAnswers* answers) {
  const mjModel& m = robot.model();
  RobotFolder folder;
  for (int b = 1; b < m.nbody; ++b) folder.parts.bodies.push_back(robot.name(mjOBJ_BODY, b));
  for (const PadSpec& pad : task.pads) folder.parts.pads.push_back(pad.name);
  for (int a = 0; a < m.nu; ++a) folder.parts.actuators.push_back(robot.name(mjOBJ_ACTUATOR, a));
  folder.frames = run.frames;
  write_robot_folder(stage, folder);
  for (int b = 0; b < m.nbody; ++b) {
    if (const TriangleMesh shape = shape_of_body(m, b); shape.num_triangles() > 0)
      write_ply(stage.output(robot_shape("", robot.name(mjOBJ_BODY, b)).string()), shape);
  }
  std::string events = csv_line({"time_s", "first", "second", "event"});
  for (const ContactEvent& event : run.events)
    events += csv_line({fmt::format("{}", event.time_s), event.first, event.second, event.begins ? "begins" : "ends"});
  write_file(stage.output(kEvents), events);
  const ArrayWriter writer(stage, {{kFrames, run.frames.size()},
                                   {kStateNumbers, run.state.size()},
                                   {kPads, task.pads.size()},
                                   {kWindowFrames, answers ? answers->frames.size() : 0}});
  writer.write(RobotArray::state, run.state);
  for (std::size_t p = 0; p < task.pads.size(); ++p)
    writer.write(field_named(field_of(RobotArray::path), task.pads[p].name), run.frames,
                 [p](const RobotFrame& frame) { return frame.pad_pose[p]; });
  write_file(stage.output("scene.yaml"),
             scene_text(stage.out(), task, objects, robot, object_start, static_cast<int>(run.frames.size()) - 1));
  if (answers) {
    writer.write(RobotArray::answers, answers->frames, [](const std::vector<PadAnswer>& frame) {
      std::vector<double> numbers;
      for (const PadAnswer& answer : frame) {
        append_numbers(numbers, answer.world_from_gel);
        append_numbers(numbers, answer.wrench);
        append_numbers(numbers, answer.gap_m);
      }
      return numbers;
    });
  }
  stage.summarize(robot_summary(folder));
}

RobotRun read_run(const fs::path& path) {
  RobotRun run;
  run.frames = read_robot_folder(path).frames;
  CsvReader events(path / kEvents);
  while (events.next())
    run.events.push_back({std::stod(events["time_s"]), events["first"], events["second"], events["event"] == "begins"});
  run.state = ArrayFolder(path, "robot").whole(field_of(RobotArray::state));
  return run;
}

std::vector<std::vector<PadAnswer>> read_basis(const fs::path& folder, std::size_t pads) {
  std::vector<std::vector<PadAnswer>> all;
  const ArrayFolder arrays(folder, "robot", {{kPads, pads}});
  if (!arrays.has(field_of(RobotArray::answers))) return all;
  const std::vector<double> numbers = arrays.whole(field_of(RobotArray::answers));
  for (const double *at = numbers.data(), *end = at + numbers.size(); at != end;) {
    for (PadAnswer& answer : all.emplace_back(pads))
      take(at, answer.world_from_gel), take(at, answer.wrench), take(at, answer.gap_m);
  }
  return all;
}

double gap_of(const TaskSpec& task, const std::vector<TaskObject>& objects, std::size_t pad,
              const Matrix4& world_from_gel, const std::vector<Matrix4>& object_poses) {
  double gap = kNowhere_m;
  for (std::size_t o = 0; o < objects.size(); ++o)
    gap = std::min(gap, gap_to(task, objects, pad, world_from_gel, o, object_poses[o]));
  return gap;
}

WindowAnswers read_answers(const fs::path& press, const TaskSpec& task, const std::vector<TaskObject>& objects,
                           std::size_t first) {
  const SceneBodies scene = read_scene_bodies(press);
  const auto number = [&](const std::string& name) {
    const auto found = std::find(scene.bodies.begin(), scene.bodies.end(), name);
    if (found == scene.bodies.end()) throw DataError("{}: has no body {}", press.string(), name);
    return static_cast<std::size_t>(found - scene.bodies.begin());
  };
  if (scene.per_frame.size() <= first)
    throw DataError("{}: has {} frames, and the window begins after frame {}", press.string(), scene.per_frame.size(),
                    first);
  const std::size_t count = scene.bodies.size();
  // An object is held in the steps that lead to frames up to held_frames().
  const auto gives_way = [&](std::size_t o, std::size_t frame) {
    return !task.objects[o].fixed && static_cast<int>(frame) > held_frames(task, task.objects[o]);
  };
  WindowAnswers answers;
  for (const TaskObject& object : objects)
    answers.inertia_n_m.push_back(object.mass_kg / (task.frame_s * task.frame_s));
  for (std::size_t f = first; f < scene.per_frame.size(); ++f) {
    std::vector<Matrix4> poses;
    auto& rigid = answers.objects.emplace_back();
    for (const ObjectSpec& object : task.objects) {
      poses.push_back(scene.body_pose[f][number(object.name)]);
      if (!object.fixed) rigid.push_back(poses.back());
    }
    std::vector<bool>& floats = answers.floats.emplace_back();
    for (std::size_t o = 0; o < task.objects.size(); ++o) {
      bool free = gives_way(o, f);
      for (std::size_t b = 0; b < count; ++b)
        free = free && (scene.kinds[b] == "gel" ||
                        scene.per_frame[f][number(task.objects[o].name) * count + b].force_n == Vector3::Zero());
      floats.push_back(free);
    }
    auto& of_frame = answers.frames.emplace_back();
    for (std::size_t p = 0; p < task.pads.size(); ++p) {
      const std::size_t gel = number(task.pads[p].name);
      PadAnswer answer{.world_from_gel = scene.body_pose[f][gel]};
      for (std::size_t b = 0; b < count; ++b) {
        answer.wrench.force_n += scene.per_frame[f][gel * count + b].force_n;
        answer.wrench.torque_n_m += scene.per_frame[f][gel * count + b].torque_n_m;
      }
      // Find the object that presses most, or the nearest one if none presses.
      double most = 0.0, nearest = kNowhere_m;
      for (std::size_t o = 0; o < task.objects.size(); ++o) {
        const double force = scene.per_frame[f][gel * count + number(task.objects[o].name)].force_n.norm();
        const double gap = gap_to(task, objects, p, answer.world_from_gel, o, poses[o]);
        if (force > most || (most == 0.0 && gap < nearest)) {
          answer.carried = floats[o] ? static_cast<int>(o) : -1;
          answer.may_slide = !floats[o] && gives_way(o, f);
        }
        most = std::max(most, force), nearest = std::min(nearest, gap);
      }
      // Refer the torque to the origin of S instead of the world's.
      answer.wrench.torque_n_m -= Vector3(answer.world_from_gel.topRightCorner<3, 1>()).cross(answer.wrench.force_n);
      answer.gap_m = nearest;
      of_frame.push_back(answer);
    }
  }
  return answers;
}

}  // namespace tacipc
