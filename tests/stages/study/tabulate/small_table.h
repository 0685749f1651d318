// A table of two methods on two images, for the tests of this folder.
#pragma once

#include <string>

#include "common/stage/named_path.h"
#include "stages/study/tabulate/method_scores.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {

inline const std::string kSmallTable =
    "title: balls\n"
    "columns: [{column: ssim_s, heading: SSIM-S, digits: 3}, {column: psnr_ln, heading: PSNR ln, digits: 1}]\n"
    "regions: [{region: full, heading: Whole image}, {region: box, heading: Contact box}]\n"
    "rows: [{name: first, method: a}, {name: second, method: b, group: others}]\n";

inline ImageTableConfig small_table(const std::string& more = "") {
  return config_from_text<ImageTableConfig>(kSmallTable + more, "t.yaml");
}

inline std::vector<MethodScores> read_methods(const std::vector<NamedPath>& tables, const ImageTableConfig& config) {
  return read_methods(tables, config.rows, config.regions, config.columns);
}

/// samples.csv of this method, in a folder of its name; PSNR of the second image's box is `last`.
inline NamedPath samples_of(const ScratchFolder& scratch, const std::string& method, const std::string& last = "30") {
  std::filesystem::create_directories(scratch / method);
  const auto file = scratch.file(method + "/samples.csv",
                                 "name,region,mae,psnr_ln,ssim_s\nx.png,full,0,10,0.5\nx.png,box,0,20,0.25\n"
                                 "y.png,full,0,14,0.75\ny.png,box,0," +
                                     last + ",0.25\n");
  return {.name = method, .path = file};
}

}  // namespace tacipc
