// Sample file of a scene: gels, soft, rigid and fixed bodies, and their motion.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/body_keys.h"
#include "common/sample/rigid_way.h"
#include "stages/gel/press/world/pair_laws.h"

namespace tacipc {

/// Kind of a body.
enum class BodyKind {
  gel,    // the sensor's gel on its mount
  soft,   // tetrahedra of a material of their own, without a mount
  rigid,  // moves freely unless a phase moves or holds it
  fixed,  // never moves
};
inline constexpr std::array kBodyKinds{"gel", "soft", "rigid", "fixed"};

/// One body of a scene.
struct BodySpec {
  std::string name = {};
  BodyKind kind = BodyKind::gel;
  /// Soft: tetrahedra (object.msh of `tetmesh --object`), or the surface from which `tetmesh` made a folder of --soft;
  /// rigid, fixed: a closed surface.
  std::filesystem::path mesh = {};
  double metres_per_unit = 1.0;         // unit of the mesh of a rigid or fixed body; a soft body is in metres
  std::filesystem::path material = {};  // soft: its mechanics, in the form of the section `material` of a sensor file
  Matrix4 world_from_body = Matrix4::Identity();
  /// Gel or rigid: array of poses, one at the start and one at the end of each time step.
  std::filesystem::path path = {};
  BodyMass mass = {};                                                    // rigid: mass
  Vector3 velocity_m_s = Vector3::Zero(), spin_rad_s = Vector3::Zero();  // rigid: initial velocity and angular velocity
};

/// Motion of one body in a phase, relative to its pose at the start of the phase.
struct WaySpec {
  int body = 0;
  RigidWay way = {};
  /// After the fraction s of the phase, the fraction smooth_part(s) of the motion is done; false: s.
  bool smooth = false;
};

/// One phase of a scene.
struct ScenePhase {
  int steps = 0;                   // number of frames
  int substeps = 1;                // number of time steps per frame
  std::vector<WaySpec> move = {};  // gels and rigid bodies with a prescribed motion
  std::vector<int> hold = {};      // rigid bodies that are held in place
  /// Load at the centre of mass of free rigid bodies. It changes linearly during this phase and is then kept until
  /// another phase sets it.
  std::vector<std::pair<int, Vector3>> load_n = {};
};

/// Specification of a scene.
struct SceneSpec {
  Vector3 gravity_m_s2 = {0.0, 0.0, -9.81};
  std::vector<BodySpec> bodies;  // ordered gel, soft, rigid, fixed; within a kind as in the file
  std::vector<ContactSpec> contact;
  std::vector<ScenePhase> motion;
  /// Time step for which paths are made; the press file's must be equal.
  std::optional<double> time_step_s = std::nullopt;

  static SceneSpec read(ConfigReader& in);
  /// Number of bodies of a kind.
  int count(BodyKind kind) const;
};

}  // namespace tacipc
