// A folder in which several gels and objects share one world, as `press` leaves a grasp or a scene: the pose of each of
// them in every frame. The only place that knows its arrays; each gel has a press folder of its own below it.
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

/// Arrays of a grasp.
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
/// Arrays of a scene.
enum class SceneArray { time, body_pose, body_twist, pair_wrench, energy, momentum, soft_positions };

/// Symbols of shapes; a scene's bodies are in the order of summary.bodies of its record.
inline constexpr std::string_view kBodies = "bodies", kRigidBodies = "rigid bodies";
/// Rows of energy.npy and of momentum.npy.
inline constexpr int kEnergies = 8, kMomenta = 5;

/// Every array, in the order of its enum: the tables that docs/files.md shows.
std::span<const NpyField> grasp_fields();
std::span<const NpyField> scene_fields();
const NpyField& field_of(GraspArray array);
const NpyField& field_of(SceneArray array);

struct SceneGel {
  std::string name;  // of its folder, which holds press/ and render/
  std::filesystem::path folder;
  std::vector<Matrix4> world_from_gel;  // m, per frame; the gel's own frame is S

  std::filesystem::path press() const { return folder / "press"; }
};

/// A rigid or fixed body.
struct SceneObject {
  std::string name;
  std::vector<Matrix4> world_from_object;  // m, per frame
  std::string input = "object";            // name of its mesh among the inputs in press.yaml
  double metres_per_unit = 1.0;            // of that mesh
  bool fixed = false;
};

/// A soft body: the vertices of its tetrahedra in the world.
struct SceneSoft {
  std::string name;
  std::string input;             // name of its mesh among the inputs in press.yaml
  std::filesystem::path folder;  // of the scene

  /// Of all frames, m. \throw DataError if there are not as many frames, or vertices, or one is not finite
  std::vector<Positions> positions(std::size_t frames, std::size_t vertices) const;
};

struct SceneFolder {
  std::vector<double> times_s;
  std::vector<SceneGel> gels;
  std::vector<SceneObject> objects;
  std::vector<SceneSoft> soft = {};
};

/// Name of a body's mesh among the inputs of a scene's record.
inline std::string body_input(const std::string& body) { return "body_" + body; }

/// Whether a press folder is that of a grasp or a scene and not of one gel.
bool is_scene_folder(const std::filesystem::path& folder);

/// \throw DataError if the press did not finish, or an array is missing, has another shape, or holds what is not finite
SceneFolder read_scene_folder(const std::filesystem::path& folder);

/// All bodies of a scene, and the wrenches between them: N, N m about the world's origin.
struct SceneBodies {
  std::vector<std::string> bodies;              // their names
  std::vector<std::string> kinds;               // gel, soft, rigid or fixed
  std::vector<std::vector<Wrench>> per_frame;   // on body a by body b, at a × number of bodies + b
  std::vector<std::vector<Matrix4>> body_pose;  // world_from_body, m, per frame
  /// J, per frame: kinetic, elastic, of the contact barrier, gravitational; since the start: work of mounts and of
  /// those who hold or load, lost by friction, by damping, by the time integration.
  std::vector<std::array<double, kEnergies>> energy_j;
};

/// \throw DataError as read_scene_folder, and for a grasp, which has none
SceneBodies read_scene_bodies(const std::filesystem::path& folder);

}  // namespace tacipc
