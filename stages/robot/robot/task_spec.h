// The file of a robot's task: its model, which parts of it are sensors, what the press owns, and what the robot does.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/sample/body_keys.h"

namespace tacipc {

/// A geom of the model that carries a gel.
struct PadSpec {
  std::string name;  // of the gel in the scene
  std::string geom;
  Matrix4 geom_from_gel = Matrix4::Identity();  // its mount: the gel's frame S in the frame of the geom
  double radius_m = 0.01;                       // of its front, as far as it is looked for what it will touch
};

/// A body of the model that the press has, too.
struct ObjectSpec {
  std::string name;    // of the body, and in the scene
  bool fixed = false;  // else rigid, on a free joint
  std::filesystem::path mesh;
  std::string unit = "m";
  BodyMass mass = {};                                                   // rigid
  std::optional<Vector3> at_m = std::nullopt, turn_rad = std::nullopt;  // where it is, instead of where the model says
  double held_s = 0.0;                                                  // rigid: until then it stays where it is
};

/// How two bodies of the scene touch, where that differs from the press file.
struct TouchSpec {
  std::vector<std::string> between;
  std::optional<double> friction = std::nullopt, d_hat_mm = std::nullopt;
};

/// What ends a step early.
struct Condition {
  std::string pad;  // its force is at least force_n; or
  double force_n = 0.0;
  std::string site;  // this point is above or below a height
  std::optional<double> above_m = std::nullopt, below_m = std::nullopt;
};

struct TaskStep {
  double seconds = 0.0;                                  // at most, with a condition
  bool smooth = true;                                    // speeding up and slowing down
  std::vector<std::pair<std::string, double>> set = {};  // controls of actuators at the end of the step; SI
  std::vector<std::pair<std::string, double>> limit =
      {};                 // largest force of actuators at its end; at once if it had none
  std::string site = {};  // that moves, by inverse kinematics; empty: none
  Vector3 by_m = Vector3::Zero(), turn_rad = Vector3::Zero();
  std::optional<Vector3> to_m = std::nullopt;  // instead of by_m
  Vector3 shake_m = Vector3::Zero();           // of this site, there and back
  double frequency_hz = 0.0;
  std::optional<Condition> until = std::nullopt;
};

/// How press and robot are brought to agree.
struct CouplingSpec {
  int window_frames = 5;               // in a window; it and most_tries are for pipelines/sample/couple.sh
  double tolerance = 1e-3;             // of the interface's wrench
  double position_tolerance_m = 5e-6;  // where the gels' answers jump, so that no wrench agrees
  int most_tries = 15;
  double stiffness_n_m = 3e4;       // of a gel, for the first try; learnt from its answers
  double smallest_wrench_n = 0.02;  // residuals are not judged against less than this
};

struct TaskSpec {
  std::filesystem::path model;                        // MJCF
  double frame_s = 0.01;                              // of the press's frames
  std::vector<std::pair<std::string, double>> start;  // of joints that servos hold: degrees of hinges, mm of slides
  std::vector<PadSpec> pads;
  std::vector<ObjectSpec> objects;
  std::vector<TouchSpec> contact;
  CouplingSpec coupling;
  std::vector<TaskStep> steps;

  static TaskSpec read(ConfigReader& in);
};

}  // namespace tacipc
