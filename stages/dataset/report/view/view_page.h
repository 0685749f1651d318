// The page of the 3-D view, the only one with a script.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/report/sample.h"
#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

inline constexpr const char* kViewPage = "view.html";
inline constexpr const char* kViewScript = "view/view.js";

/// Where the data of a view lie; `id` is that of what it shows on the page of all samples.
std::string view_data_name(const std::string& id);
/// From that page to the view; `place`: its id, or of one of its gels, seen in its own frame, "id/name".
std::string view_link(const std::string& place);

/// What is said of each frame of a view: "frame 3 of 6 · shear · 0.12 s · press force 1.2 N".
std::vector<std::string> frame_texts(const SampleReport& sample, const SceneView& view);

/// What has a view: its id on the page of all samples and its name.
struct ViewedSample {
  std::string id, name;
};

std::string view_page(const std::string& title, const std::vector<ViewedSample>& samples);
/// The source of view.js.
std::string view_program();

}  // namespace tacipc
