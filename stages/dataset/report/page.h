// The page over all samples: one static HTML file with links to the pictures where they lie.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "stages/dataset/report/sample.h"

namespace tacipc {

/// The whole page. `folder` is where it will lie; links are relative to it. `first`: a section before all others.
std::string report_page(const std::string& title, const std::vector<SampleReport>& samples,
                        const std::filesystem::path& folder, const std::string& first = "");

}  // namespace tacipc
