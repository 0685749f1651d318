// Opens a finished press, grasp or scene, and checks it against the gel and the object with which it is exported.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/press_folder.h"

namespace tacipc {

/// Opens a press folder.
/// \param object_path absent for a scene, whose record names its bodies
/// \param frames required number of frames; absent: any
/// \throw DataError if the press did not finish, was made with another gel or object (by content hash), or an array
/// does not fit the gel, the other arrays or the number of frames
PressFolder open_press(const std::filesystem::path& folder, const std::filesystem::path& gel_path, const TetMesh& gel,
                       const std::optional<std::filesystem::path>& object_path,
                       std::optional<std::size_t> frames = std::nullopt);

/// A gel with its press.
struct OpenGel {
  std::string name;  // empty if it is the only one
  TetMesh mesh;
  PressFolder press;
  std::vector<Matrix4> world_from_gel;  // m, per frame; empty if its frame S is the world
};

/// An object and its poses.
struct OpenObject {
  std::string name;  // empty if it is the only one
  TriangleMesh mesh;
  std::vector<Matrix4> world_from_object;  // m, per frame
};

/// A soft body and its positions.
struct OpenSoft {
  std::string name;
  TetMesh mesh;
  std::vector<Positions> positions;  // m, in the world, per frame
};

/// All bodies of a finished run.
struct OpenScene {
  std::vector<double> times_s;
  std::vector<OpenGel> gels;
  std::vector<OpenObject> objects;
  std::vector<OpenSoft> soft = {};
};

/// Opens the folder of a press, which is one gel and one object in frame S, of a grasp, or of a scene.
/// \throw DataError as open_press(), or if a body of a scene is not the one that the record names
/// \throw UsageError if the object is missing, or given for a scene
OpenScene open_scene(const std::filesystem::path& folder, const std::filesystem::path& gel_path,
                     const std::optional<std::filesystem::path>& object_path);

}  // namespace tacipc
