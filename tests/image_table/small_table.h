// A table of two methods on two images, for the tests of this folder.
#pragma once

#include <string>

#include "stages/image_table/image_table_config.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {

inline const std::string kSmallTable =
    "title: balls\n"
    "columns: [{column: ssim_s, heading: SSIM-S, digits: 3}, {column: psnr_ln, heading: PSNR ln, digits: 1}]\n"
    "regions: [{region: full, heading: Whole image}, {region: box, heading: Contact box}]\n"
    "rows: [{name: first, folder: a}, {name: second, folder: b, group: others}]\n";

inline ImageTableConfig small_table(const std::string& more = "") {
  return config_from_text<ImageTableConfig>(kSmallTable + more, "t.yaml");
}

/// samples.csv in a folder of this name; PSNR of the second image's box is `last`.
inline std::filesystem::path samples_in(const ScratchFolder& scratch, const std::string& folder,
                                        const std::string& last = "30") {
  std::filesystem::create_directories(scratch / folder);
  return scratch.file(folder + "/samples.csv",
                      "name,region,mae,psnr_ln,ssim_s\nx.png,full,0,10,0.5\nx.png,box,0,20,0.25\n"
                      "y.png,full,0,14,0.75\ny.png,box,0," +
                          last + ",0.25\n");
}

}  // namespace tacipc
