// Configuration of the pages of single samples.
#pragma once

#include "common/config/config.h"

namespace tacipc {

/// Content of configs/datasets/report/*.yaml. Coverage, counts and costs always include all samples.
struct DatasetReportConfig {
  int made = 0;        // number of made samples with a page of their own
  int failed = 0;      // number of failed samples with a page of their own
  int rows = 0;        // samples on one page of the list
  int sheet = 0;       // pictures on one contact sheet
  int picture_px = 0;  // longer side of a picture on a sample's page
  int thumb_px = 0;    // longer side of a picture on a contact sheet

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
