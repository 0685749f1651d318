// Means and standard deviations of what `metrics` measured, method by method.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/mean_deviation.h"
#include "stages/image_table/image_table_config.h"

namespace tacipc {

/// One method in all regions and columns of the table.
struct MethodRow {
  MeasuredRow row;
  std::vector<std::string> images;  // ascending
  /// By region and column of samples.csv. Of geometric columns exp(mean ln) and exp(deviation of ln), a factor.
  std::map<std::pair<std::string, std::string>, MeanDeviation> cells;

  const MeanDeviation& cell(const std::string& region, const std::string& column) const {
    return cells.at({region, column});
  }
};

/// The tables of metrics in the order of the configuration's rows, found by the name of the folder each lies in.
/// \throw DataError if a row has no table, a table no row, a table lacks a column or region, or the methods were not
/// measured on images of the same names
std::vector<MethodRow> read_method_rows(const std::vector<std::filesystem::path>& tables,
                                        const ImageTableConfig& config);

}  // namespace tacipc
