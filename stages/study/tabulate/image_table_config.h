// Configuration of a table of kind images: configs/studies/paper/tables/objects.yaml
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// Column of samples.csv as the table shows it.
struct ShownColumn {
  std::string column;
  std::string heading;
  int digits = 3;          // digits after the point
  bool geometric = false;  // use mean and deviation of logarithms: for ratios, where 2 and 1/2 are equally far from 1
};

/// Image region that gets a table of its own.
struct ShownRegion {
  std::string region;  // full, crop or box; for depth maps full, pressed, contact or beside
  std::string heading;
};

/// Method measured here: the samples.csv that was given for it, or one per run.
struct MeasuredRow {
  std::string name;
  std::string method;
  std::string group;          // rows of one group stand together under its name; empty: no such line
  std::string timed_as = {};  // method whose measured speed is shown
};

/// Means printed by someone else, shown next to the measured ones.
struct PrintedRow {
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;  // column of samples.csv, and the mean as printed

  std::optional<std::string> value(const std::string& column) const;
};

/// Group of printed means.
struct PrintedRows {
  std::string label;   // note to read before comparing
  std::string source;  // source of the printed numbers
  std::string region;  // region whose table shows them
  std::vector<PrintedRow> rows;
};

/// Column of the sheet: the pictures that were given for a method.
struct SheetColumn {
  std::string heading;
  std::string method;
};

/// Sentence below the tables that compares the first row's mean with the second's, in one column of one region.
struct Finding {
  std::string region;
  std::string column;
  std::string row;  // methods of the two rows, `row` and `against`
  std::string against;
  std::string below;  // meaning of a ratio of the means below 1
  std::string above;  // meaning of any other ratio
  std::vector<std::string> variants =
      {};  // methods that are `row` with other settings; all must lie on the same side of 1
};

/// Sheet of pictures below the tables.
struct SheetConfig {
  std::string name;                           // file name without .png
  std::string alt;                            // alternative text of the picture
  std::optional<std::array<int, 4>> crop_px;  // x, y, width, height in every picture
  int picture_px = 0;                         // width of each picture on the sheet
  std::vector<SheetColumn> columns;
};

/// Configuration of the page.
struct ImageTableConfig {
  std::string title;
  std::string caption;      // text below the tables
  std::string link_folder;  // folder of the pictures, as seen from the final location of table.md
  std::vector<ShownColumn> columns;
  std::vector<ShownRegion> regions;
  std::vector<MeasuredRow> rows;
  std::vector<std::string> uncounted;  // measured images that calibrate, and therefore count in no mean
  std::optional<PrintedRows> printed;
  std::vector<Finding> findings;
  std::vector<SheetConfig> sheets;

  static ImageTableConfig read(ConfigReader& in);
};

}  // namespace tacipc
