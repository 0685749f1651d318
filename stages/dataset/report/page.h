// Page over all samples: one static HTML file with links to the pictures where they are stored.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stages/dataset/report/sample.h"

namespace tacipc {

/// Texts on a page about samples that belong together.
struct PageWords {
  std::string intro =
      "Simulated touch: each sample presses one object into the soft gel of a camera-based tactile sensor.";
  std::string thing = "sample", heading = "Samples";  // name of one of them, and heading of all
  std::string first = {};                             // section before all others
};

/// The whole page. `folder` is its final folder, to which links are relative.
std::string report_page(const std::string& title, const std::vector<SampleReport>& samples,
                        const std::filesystem::path& folder, const PageWords& words = {});

}  // namespace tacipc
