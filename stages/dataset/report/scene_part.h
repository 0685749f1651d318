// Shows a scene on a page in addition to its gels: forces between bodies, motion of rigid bodies, energies, and a row
// of sensor images.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/sample/scene_folder.h"
#include "stages/dataset/report/page.h"
#include "stages/dataset/report/timeline.h"
#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

/// Data of a scene from its folder.
struct SceneReport {
  std::vector<Instant> frames;
  SceneBodies bodies;
  bool has_view = false;  // a 3-D view exists for the page
};

/// Reads a scene.
/// \throw DataError if the folder has no record of a scene
SceneReport read_scene(const std::filesystem::path& folder);

inline constexpr const char* kSceneStrip = "scene_strip.png";
/// Id of the section on the page, and of the scene's view.
inline constexpr const char* kSceneId = "scene";

/// Text of the page on the scene; the strip of its pictures lies next to it under kSceneStrip.
PageWords scene_words(const SceneReport& scene);

/// Caption of each frame of a view, such as "frame 12 of 40 · phase 2 · 0.12 s · left and block 4.98 N".
std::vector<std::string> scene_texts(const SceneReport& scene, const SceneView& view);

}  // namespace tacipc
