// Samples that have a page of their own, and what contact sheets and lists show of them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/sample/dataset_plan.h"

namespace tacipc {

struct SampleShot {
  PlannedRow plan;
  bool passed = true;
  std::optional<std::pair<int, int>> thumb_px = std::nullopt;  // width and height of pictures/<id>/thumb.jpg
};

/// The pictures of these samples as links to their pages.
std::string shots_list(const std::vector<SampleShot>& shots, std::size_t first, std::size_t count);

}  // namespace tacipc
