// A folder in which several gels and objects share one world, as `press` leaves a grasp or a scene: where each of them
// is in every frame. The only reader of its arrays; each gel has a press folder of its own below it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

struct SceneGel {
  std::string name;  // of its folder, which holds press/ and render/
  std::filesystem::path folder;
  std::vector<Matrix4> world_from_gel;  // m, per frame; the gel's own frame is S

  std::filesystem::path press() const { return folder / "press"; }
};

struct SceneObject {
  std::string name;                        // of its mesh among the inputs in press.yaml
  std::vector<Matrix4> world_from_object;  // m, per frame
};

struct SceneFolder {
  std::vector<double> times_s;
  std::vector<SceneGel> gels;
  std::vector<SceneObject> objects;
};

/// Name of a body's mesh among the inputs of a scene's record.
inline std::string body_input(const std::string& body) { return "body_" + body; }

/// Whether a press folder is that of a grasp and not of one gel.
bool is_scene_folder(const std::filesystem::path& folder);

/// \throw DataError if the press did not finish, or an array is missing, has another shape, or holds what is not finite
SceneFolder read_scene_folder(const std::filesystem::path& folder);

}  // namespace tacipc
