// A sample's own page, with small copies of its pictures, so that the pages can be given away without the samples.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stages/dataset/report/dataset/report_config.h"
#include "stages/dataset/report/dataset/site.h"

namespace tacipc {

struct SamplePage {
  SampleShot shot;
  std::vector<std::pair<std::string, std::string>> pictures;  // name below the pages' folder, JPEG
  std::string body;                                           // HTML
};

/// Reads and judges the sample. `folder` is where the first page will lie.
SamplePage make_sample_page(const PlannedRow& plan, const std::filesystem::path& dataset,
                            const std::filesystem::path& folder, const DatasetReportConfig& config);

/// The whole page. `before` and `after` are the previous and the next sample.
std::string sample_page_html(const std::string& dataset, const SamplePage& page, const PlannedRow* before,
                             const PlannedRow* after, const std::string& list_page);

}  // namespace tacipc
