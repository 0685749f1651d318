// How much of a dataset is shown sample by sample.
#pragma once

#include "common/config/config.h"

namespace tacipc {

/// configs/datasets/report/*.yaml. Coverage, counts and costs are of all samples, whatever these say.
struct DatasetReportConfig {
  int made = 0;        // made samples with a page of their own
  int failed = 0;      // failed ones
  int rows = 0;        // samples on one page of the list
  int sheet = 0;       // pictures on one contact sheet
  int picture_px = 0;  // longer side of a picture on a sample's page
  int thumb_px = 0;    // of one on a contact sheet

  static DatasetReportConfig read(ConfigReader& in) {
    return {.made = in.integer("made", 0, 100000),
            .failed = in.integer("failed", 0, 100000),
            .rows = in.integer("rows", 1, 10000),
            .sheet = in.integer("sheet", 1, 10000),
            .picture_px = in.integer("picture_px", 16, 4096),
            .thumb_px = in.integer("thumb_px", 16, 4096)};
  }
};

}  // namespace tacipc
