// What the stages of many samples cost, row by row.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/config.h"
#include "common/mean_deviation.h"

namespace tacipc {

/// configs/cost_table/*.yaml
struct CostTableConfig {
  struct Row {
    std::string name;
    std::string stage;
    std::string folder;  // only timings that lie in a folder of this name; empty: all of the stage
    std::string per;     // what one run of it serves: sample, object, sensor
  };
  std::string title;
  std::string caption;
  std::vector<Row> rows;

  static CostTableConfig read(ConfigReader& in);
};

struct Cost {
  std::string name;
  std::string per;
  std::size_t runs = 0;
  MeanDeviation processor_s;
  double largest_s = 0.0;
  double peak_memory_mb = 0.0;  // largest of all runs
};

/// One entry per row. \throw DataError if a row has no timings
std::vector<Cost> costs_of(const std::vector<std::filesystem::path>& timings, const CostTableConfig& config);

/// A Markdown table with a line per row, then the caption; and the same as CSV.
std::string to_markdown(const std::vector<Cost>& costs, const CostTableConfig& config);
std::string to_csv(const std::vector<Cost>& costs);

}  // namespace tacipc
