// The sample file of a scene: gels, soft, rigid and fixed bodies, and what moves them.
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
  rigid,  // moves freely but where a phase moves or holds it
  fixed,  // never moves
};
inline constexpr std::array kBodyKinds{"gel", "soft", "rigid", "fixed"};

struct BodySpec {
  std::string name = {};
  BodyKind kind = BodyKind::gel;
  /// Soft: tetrahedra (object.msh of `tetmesh --object`), or the surface that a folder has these of; rigid, fixed: a
  /// closed surface.
  std::filesystem::path mesh = {};
  double metres_per_unit = 1.0;         // of the mesh of a rigid or fixed body; a soft one is in metres
  std::filesystem::path material = {};  // soft: its mechanics, as the section `material` of a sensor file
  Matrix4 world_from_body = Matrix4::Identity();
  /// Gel or rigid: an array of poses, one for the start and one for the end of each time step, which it goes through.
  std::filesystem::path path = {};
  BodyMass mass = {};                                                    // rigid
  Vector3 velocity_m_s = Vector3::Zero(), spin_rad_s = Vector3::Zero();  // rigid: how it starts
};

/// The way of one body in a phase, from where it is at its start.
struct WaySpec {
  int body = 0;
  RigidWay way = {};
  bool smooth = false;  // smooth_part(s) of it after the part s of the phase, else s
};

struct ScenePhase {
  int steps = 0;                   // frames
  int substeps = 1;                // time steps per frame
  std::vector<WaySpec> move = {};  // gels and rigid bodies that go where they are told
  std::vector<int> hold = {};      // rigid bodies that stay where they are
  /// On rigid bodies that are free, at their centre of mass: reached evenly in this phase, kept until another is named.
  std::vector<std::pair<int, Vector3>> load_n = {};
};

struct SceneSpec {
  Vector3 gravity_m_s2 = {0.0, 0.0, -9.81};
  std::vector<BodySpec> bodies;  // in the order gel, soft, rigid, fixed, each kind as the file has them
  std::vector<ContactSpec> contact;
  std::vector<ScenePhase> motion;
  std::optional<double> time_step_s = std::nullopt;  // that paths are made for: the press file's must be the same

  static SceneSpec read(ConfigReader& in);
  /// How many there are of a kind.
  int count(BodyKind kind) const;
};

}  // namespace tacipc
