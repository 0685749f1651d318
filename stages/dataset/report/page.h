// The page over all samples: one static HTML file with links to the pictures where they lie.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stages/dataset/report/sample.h"

namespace tacipc {

/// What is said of samples that belong together.
struct PageWords {
  std::string intro =
      "Simulated touch: each sample presses one object into the soft gel of a camera-based tactile sensor.";
  std::string thing = "sample", heading = "Samples";  // what each of them is, and all
  std::string first = {};                             // a section before all others
};

/// The whole page. `folder` is where it will lie; links are relative to it.
std::string report_page(const std::string& title, const std::vector<SampleReport>& samples,
                        const std::filesystem::path& folder, const PageWords& words = {});

}  // namespace tacipc
