// Page of a single sample, with small copies of its pictures, so that the pages can be published without the samples.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stages/dataset/report/dataset/report_config.h"
#include "stages/dataset/report/dataset/site.h"

namespace tacipc {

/// A sample's page and the pictures that it links.
struct SamplePage {
  SampleShot shot;
  std::vector<std::pair<std::string, std::string>> pictures;  // JPEG pictures, by names below the pages' folder
  std::string body;                                           // HTML
};

/// Reads and judges the sample. `folder` is the final folder of the first page.
SamplePage make_sample_page(const PlannedRow& plan, const std::filesystem::path& dataset,
                            const std::filesystem::path& folder, const DatasetReportConfig& config);

/// The whole page. `before` and `after` are the previous and the next sample.
std::string sample_page_html(const std::string& dataset, const SamplePage& page, const PlannedRow* before,
                             const PlannedRow* after, const std::string& list_page);

}  // namespace tacipc
