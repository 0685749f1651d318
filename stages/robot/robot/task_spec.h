// Reads a robot's task file: the model, the geoms that are sensors, the objects that the press simulates, the steps.
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

/// A geom of the model on which a gel is mounted.
struct PadSpec {
  std::string name;                             // name of the gel in the scene
  std::string geom;                             // name of the geom in the model
  Matrix4 geom_from_gel = Matrix4::Identity();  // mount: the gel's frame S in the geom's frame
  double radius_m = 0.01;  // half-width of the square of the front that is searched for surfaces ahead
};

/// A body of the model that the press also simulates.
struct ObjectSpec {
  std::string name;    // name of the body in the model and the scene
  bool fixed = false;  // false: rigid, on a free joint
  std::filesystem::path mesh;
  std::string unit = "m";
  BodyMass mass = {};                                                   // rigid objects only
  std::optional<Vector3> at_m = std::nullopt, turn_rad = std::nullopt;  // pose that replaces the model's
  double held_s = 0.0;  // time until which a rigid object is held in place
};

/// Contact settings of two bodies that replace those of the press file.
struct TouchSpec {
  std::vector<std::string> between;
  std::optional<double> friction = std::nullopt, d_hat_mm = std::nullopt;
};

/// Condition that ends a step early: the force on a pad reaches force_n, or a site passes a height.
struct Condition {
  std::string pad;  // name of the pad; empty: the condition is on a site
  double force_n = 0.0;
  std::string site;  // name of the site
  std::optional<double> above_m = std::nullopt, below_m = std::nullopt;
};

/// One step of a task.
struct TaskStep {
  double seconds = 0.0;                                  // duration, an upper limit if there is a condition
  bool smooth = true;                                    // accelerate and decelerate smoothly
  std::vector<std::pair<std::string, double>> set = {};  // actuator controls at the end of the step, SI
  std::vector<std::pair<std::string, double>> limit =
      {};                 // force limits of actuators at the end of the step; immediate for unlimited ones
  std::string site = {};  // site that moves by inverse kinematics; empty: no site
  Vector3 by_m = Vector3::Zero(), turn_rad = Vector3::Zero();  // displacement and rotation vector
  std::optional<Vector3> to_m = std::nullopt;                  // target that replaces by_m
  Vector3 shake_m = Vector3::Zero();                           // peak displacement of the site, there and back
  double frequency_hz = 0.0;
  std::optional<Condition> until = std::nullopt;
};

/// Settings of the iteration between press and robot.
struct CouplingSpec {
  int window_frames = 5;               // frames per window; read by pipelines/sample/couple.sh, as is most_tries
  double tolerance = 1e-3;             // largest relative residual of the wrenches
  double position_tolerance_m = 5e-6;  // largest position residual; used if no wrench agrees (the response jumps)
  int most_tries = 15;                 // most iterations per window
  double stiffness_n_m = 3e4;          // stiffness of a gel, for the first iteration; later ones estimate it
  double smallest_wrench_n = 0.02;     // least reference force of the relative residual
};

/// Contents of a task file.
struct TaskSpec {
  std::filesystem::path model;                        // MJCF
  double frame_s = 0.01;                              // interval between frames of the press
  std::vector<std::pair<std::string, double>> start;  // joints held by servos: degrees for hinges, mm for slides
  std::vector<PadSpec> pads;
  std::vector<ObjectSpec> objects;
  std::vector<TouchSpec> contact;
  CouplingSpec coupling;
  std::vector<TaskStep> steps;

  /// Reads the task.
  /// \throw ConfigError if a value is missing or not allowed
  static TaskSpec read(ConfigReader& in);
};

}  // namespace tacipc
