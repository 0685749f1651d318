// Page of the 3-D view, the only page with a script.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/report/sample.h"
#include "stages/dataset/report/view/scene_view.h"

namespace tacipc {

inline constexpr const char* kViewPage = "view.html";
inline constexpr const char* kViewScript = "view/view.js";

/// Path of the data of a view; `id` is the id of its subject on the page of all samples.
std::string view_data_name(const std::string& id);
/// Link from that page to the view; `place` is its id, or "id/name" for one of its gels, seen in its own frame.
std::string view_link(const std::string& place);

/// Caption of each frame of a view, such as "frame 3 of 6 · shear · 0.12 s · press force 1.2 N".
std::vector<std::string> frame_texts(const SampleReport& sample, const SceneView& view);

/// Subject of a view: its id on the page of all samples, and its name.
struct ViewedSample {
  std::string id, name;
};

std::string view_page(const std::string& title, const std::vector<ViewedSample>& samples);
/// Source of view.js.
std::string view_program();

}  // namespace tacipc
