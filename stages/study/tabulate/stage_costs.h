// Tabulates the cost of the stages of many samples.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/base/statistics.h"
#include "common/config/config.h"

namespace tacipc {

/// Content of configs/studies/paper/tables/costs.yaml.
struct StageCostsConfig {
  struct Row {
    std::string name;
    std::string stage;
    std::string folder;  // use only timings in a folder of this name below the common folder; empty: all of the stage
    std::string per;     // unit that one run serves: sample, object, sensor
  };
  struct Sum {
    std::string name;
    std::string per;
    std::vector<std::string> of;  // names of rows
  };
  std::string title;
  std::string caption;
  std::vector<Row> rows;
  std::vector<Sum> sums;  // sums shown below the rows

  static StageCostsConfig read(ConfigReader& in);
};

/// Cost of one row or sum.
struct Cost {
  std::string name;
  std::string per;
  std::size_t runs = 0;
  MeanDeviation processor_s;
  double largest_s = 0.0;
  double peak_memory_mb = 0.0;  // largest peak of all runs
};

/// One entry per row.
/// \throw DataError if a row has no timings
std::vector<Cost> costs_of(const std::vector<std::filesystem::path>& timings, const StageCostsConfig& config);

/// Markdown table with a line per row and sum (the sum of the rows' means, the largest of their memory), then the
/// caption; the rows as CSV.
std::string to_markdown(const std::vector<Cost>& costs, const StageCostsConfig& config);
std::string to_csv(const std::vector<Cost>& costs);

}  // namespace tacipc
