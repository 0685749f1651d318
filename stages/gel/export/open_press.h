// A finished press or grasp, checked against the gel and the object that it is exported with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/press_folder.h"

namespace tacipc {

/// \param object_path none: of a scene, whose record names its bodies
/// \throw DataError if the press did not finish, was of another gel or object (by content hash), or an array does not
/// fit the gel or the others, or has another number of frames than this
PressFolder open_press(const std::filesystem::path& folder, const std::filesystem::path& gel_path, const TetMesh& gel,
                       const std::optional<std::filesystem::path>& object_path,
                       std::optional<std::size_t> frames = std::nullopt);

struct OpenGel {
  std::string name;  // empty where it is the only one
  TetMesh mesh;
  PressFolder press;
  std::vector<Matrix4> world_from_gel;  // m, per frame; none where its frame S is the world
};

struct OpenObject {
  std::string name;  // empty where it is the only one
  TriangleMesh mesh;
  std::vector<Matrix4> world_from_object;  // m, per frame
};

struct OpenSoft {
  std::string name;
  TetMesh mesh;
  std::vector<Positions> positions;  // m, in the world, per frame
};

struct OpenScene {
  std::vector<double> times_s;
  std::vector<OpenGel> gels;
  std::vector<OpenObject> objects;
  std::vector<OpenSoft> soft = {};
};

/// The folder of a press, which is one gel and one object in frame S, of a grasp, or of a scene.
/// \throw DataError as open_press, or if a body of a scene is not the one that the record names; UsageError if the
/// object is missing, or given for a scene
OpenScene open_scene(const std::filesystem::path& folder, const std::filesystem::path& gel_path,
                     const std::optional<std::filesystem::path>& object_path);

}  // namespace tacipc
