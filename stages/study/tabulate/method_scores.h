// Collects the measurements of `metrics` by method, with means and standard deviations over the images or over runs.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/base/statistics.h"
#include "common/stage/named_path.h"
#include "stages/study/tabulate/image_table_config.h"

namespace tacipc {

/// One method in all regions and columns of a table.
struct MethodScores {
  /// Mean and deviation; for geometric columns exp(mean ln) and the factor exp(deviation of ln).
  struct Cell : MeanDeviation {
    std::vector<double> values;  // value of each image, mean over the runs
  };
  MeasuredRow row;
  std::size_t runs = 1;
  std::size_t counted = 0;          // number of images in the means
  std::vector<std::string> images;  // image names in the order of samples.csv, the same in all regions
  std::map<std::pair<std::string, std::string>, Cell> cells;  // key: region and column of samples.csv

  const Cell& cell(const std::string& region, const std::string& column) const { return cells.at({region, column}); }
};

/// Reads the samples.csv of metrics, given by their methods, in the order of the rows. Several tables of one method are
/// its runs: mean and deviation are then those of the runs' means over the images. Images named in `uncounted` (without
/// folder and ending) are read but do not count in the means.
/// \throw DataError if a row has no table or a table no row, a table lacks a column or region or has an image twice, or
/// regions, methods or runs were not measured on images of the same names
std::vector<MethodScores> read_methods(const std::vector<NamedPath>& tables, const std::vector<MeasuredRow>& rows,
                                       const std::vector<ShownRegion>& regions, const std::vector<ShownColumn>& columns,
                                       const std::set<std::string>& uncounted = {});

}  // namespace tacipc
