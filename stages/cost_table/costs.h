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
    std::string
        folder;       // only timings in a folder of this name, below what all of them lie in; empty: all of the stage
    std::string per;  // what one run of it serves: sample, object, sensor
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

/// Means of rows added up, and the largest of their memory.
struct CostSum {
  std::string name;
  std::string per;
  double processor_s = 0.0;
  double peak_memory_mb = 0.0;
};

std::vector<CostSum> sums_of(const std::vector<Cost>& costs, const CostTableConfig& config);

/// One entry per row. \throw DataError if a row has no timings
std::vector<Cost> costs_of(const std::vector<std::filesystem::path>& timings, const CostTableConfig& config);

/// A Markdown table with a line per row and sum, then the caption; the rows as CSV.
std::string to_markdown(const std::vector<Cost>& costs, const CostTableConfig& config);
std::string to_csv(const std::vector<Cost>& costs);

}  // namespace tacipc
