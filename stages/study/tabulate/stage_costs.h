// What the stages of many samples cost, row by row.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/statistics.h"
#include "common/config/config.h"

namespace tacipc {

/// configs/studies/paper/tables/costs.yaml
struct StageCostsConfig {
  struct Row {
    std::string name;
    std::string stage;
    std::string folder;  // only timings in a folder of this name, below what all lie in; empty: all of the stage
    std::string per;     // what one run of it serves: sample, object, sensor
  };
  struct Sum {
    std::string name;
    std::string per;
    std::vector<std::string> of;  // names of rows
  };
  std::string title;
  std::string caption;
  std::vector<Row> rows;
  std::vector<Sum> sums;  // below the rows

  static StageCostsConfig read(ConfigReader& in);
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
std::vector<Cost> costs_of(const std::vector<std::filesystem::path>& timings, const StageCostsConfig& config);

/// A Markdown table with a line per row and sum (means of rows added up, the largest of their memory), then the
/// caption; the rows as CSV.
std::string to_markdown(const std::vector<Cost>& costs, const StageCostsConfig& config);
std::string to_csv(const std::vector<Cost>& costs);

}  // namespace tacipc
