// The folder of a grasp or scene that `press` writes: several gels and objects in one world, with the pose of each in
// every frame. The only unit that declares its arrays; each gel has a press folder below this folder.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/types.h"
#include "common/base/wrench.h"
#include "common/sample/array_folder.h"

namespace tacipc {

/// Arrays of a grasp's folder.
enum class GraspArray {
  time,
  object_world_pose,
  object_world_twist,
  hand_pose,
  finger_pose,
  finger_force,
  finger_drive,
  energy,
  momentum
};
/// Arrays of a scene's folder.
enum class SceneArray { time, body_pose, body_twist, pair_wrench, energy, momentum, soft_positions };

/// Symbols in array shapes. Bodies of a scene are in the order of summary.bodies of the record.
inline constexpr std::string_view kBodies = "bodies", kRigidBodies = "rigid bodies";
/// Numbers of rows of energy.npy and momentum.npy.
inline constexpr int kEnergies = 8, kMomenta = 5;

/// Return the declarations of all arrays in the order of the enums: the tables of docs/files.md.
std::span<const NpyField> grasp_fields();
std::span<const NpyField> scene_fields();
/// Return the declaration of an array.
const NpyField& field_of(GraspArray array);
const NpyField& field_of(SceneArray array);

/// A gel of a grasp or scene.
struct SceneGel {
  std::string name;  // name of the folder that holds press/ and render/
  std::filesystem::path folder;
  std::vector<Matrix4> world_from_gel;  // per frame, m; the gel's frame is S

  std::filesystem::path press() const { return folder / "press"; }
};

/// A rigid or fixed body.
struct SceneObject {
  std::string name;
  std::vector<Matrix4> world_from_object;  // per frame, m
  std::string input = "object";            // name of the mesh among the inputs in press.yaml
  double metres_per_unit = 1.0;            // unit of the mesh
  bool fixed = false;
};

/// A soft body: the vertices of its tetrahedral mesh in the world.
struct SceneSoft {
  std::string name;
  std::string input;             // name of the mesh among the inputs in press.yaml
  std::filesystem::path folder;  // folder of the scene

  /// Returns the vertices in all frames, m.
  /// \throw DataError if the numbers of frames or vertices differ, or a value is not finite
  std::vector<Positions> positions(std::size_t frames, std::size_t vertices) const;
};

/// Contents of the folder.
struct SceneFolder {
  std::vector<double> times_s;
  std::vector<SceneGel> gels;
  std::vector<SceneObject> objects;
  std::vector<SceneSoft> soft = {};
};

/// Returns the name of a body's mesh among the inputs of a scene's record.
inline std::string body_input(const std::string& body) { return "body_" + body; }

/// Returns whether a press folder belongs to a grasp or scene instead of a single gel.
bool is_scene_folder(const std::filesystem::path& folder);

/// Reads the folder.
/// \throw DataError if the press run did not finish, or an array is missing, has another shape, or holds values that
/// are not finite
SceneFolder read_scene_folder(const std::filesystem::path& folder);

/// Bodies of a scene, and the wrenches between them: N, N m about the world's origin.
struct SceneBodies {
  std::vector<std::string> bodies;              // names
  std::vector<std::string> kinds;               // gel, soft, rigid or fixed
  std::vector<std::vector<Wrench>> per_frame;   // wrench on body a by body b, at index a × number of bodies + b
  std::vector<std::vector<Matrix4>> body_pose;  // world_from_body, per frame, m
  /// Energies per frame, J. Current: kinetic, elastic, contact barrier, gravitational. Accumulated since the start:
  /// work of mounts, holders and loads; losses to friction, damping and time integration.
  std::vector<std::array<double, kEnergies>> energy_j;
};

/// Reads the bodies of a scene.
/// \throw DataError as read_scene_folder(), or if the folder belongs to a grasp
SceneBodies read_scene_bodies(const std::filesystem::path& folder);

}  // namespace tacipc
