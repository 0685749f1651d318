// Of a table of kind images: configs/studies/paper/tables/objects.yaml
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config.h"

namespace tacipc {

/// A column of samples.csv as the table shows it.
struct ShownColumn {
  std::string column;
  std::string heading;
  int digits = 3;          // after the point
  bool geometric = false;  // mean and deviation of logarithms: for ratios, of which 2 and 1/2 are equally far from 1
};

/// A part of the images that gets a table of its own.
struct ShownRegion {
  std::string region;  // full, crop, box; of depth maps full, pressed, contact, beside
  std::string heading;
};

/// A method measured here: the samples.csv that was given for it, or those of its runs.
struct MeasuredRow {
  std::string name;
  std::string method;
  std::string group;          // rows of one group stand together under its name; empty: no such line
  std::string timed_as = {};  // method of whose images the speed is shown
};

/// Means that somebody else printed, beside the measured ones.
struct PrintedRow {
  std::string name;
  std::vector<std::pair<std::string, std::string>> values;  // column of samples.csv, and the mean as it was printed

  std::optional<std::string> value(const std::string& column) const;
};

struct PrintedRows {
  std::string label;   // what the reader must know before comparing
  std::string source;  // where they were printed
  std::string region;  // in whose table they stand
  std::vector<PrintedRow> rows;
};

/// A column of the sheet: the pictures that were given for a method.
struct SheetColumn {
  std::string heading;
  std::string method;
};

/// A sentence below the tables: how the first row's mean compares with the second's in one column of one region.
struct Finding {
  std::string region;
  std::string column;
  std::string row;  // methods of rows
  std::string against;
  std::string below;                       // what it means if the ratio of the means is below 1,
  std::string above;                       // and if it is not
  std::vector<std::string> variants = {};  // methods that are `row` with other settings: all must be on the same side
};

struct SheetConfig {
  std::string name;                           // of the file, without .png
  std::string alt;                            // what the page says for who does not see it
  std::optional<std::array<int, 4>> crop_px;  // x, y, width, height, of every picture
  int picture_px = 0;                         // width of each on the sheet
  std::vector<SheetColumn> columns;
};

struct ImageTableConfig {
  std::string title;
  std::string caption;      // below the tables
  std::string link_folder;  // of the pictures, as seen from where table.md is going to stand
  std::vector<ShownColumn> columns;
  std::vector<ShownRegion> regions;
  std::vector<MeasuredRow> rows;
  std::vector<std::string> uncounted;  // images that were measured but calibrate: in no mean
  std::optional<PrintedRows> printed;
  std::vector<Finding> findings;
  std::vector<SheetConfig> sheets;

  static ImageTableConfig read(ConfigReader& in);
};

}  // namespace tacipc
