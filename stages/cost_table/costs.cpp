#include "stages/cost_table/costs.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/csv.h"
#include "common/error.h"
#include "common/stage_timings.h"

namespace tacipc {

CostTableConfig CostTableConfig::read(ConfigReader& in) {
  CostTableConfig config{.title = in.text("title"), .caption = in.text_or("caption", ""), .rows = {}, .sums = {}};
  for (ConfigReader& item : in.one_or_more_sections("rows"))
    config.rows.push_back({.name = item.text("name"),
                           .stage = item.text("stage"),
                           .folder = item.text_or("folder", ""),
                           .per = item.text("per")});
  for (ConfigReader& item : in.sections("sums")) {
    CostTableConfig::Sum sum{.name = item.text("name"), .per = item.text("per"), .of = item.texts("of")};
    for (const std::string& name : sum.of)
      if (std::none_of(config.rows.begin(), config.rows.end(), [&](const auto& row) { return row.name == name; }))
        item.fault("of", "'" + name + "' is none of the rows");
    config.sums.push_back(std::move(sum));
  }
  return config;
}

std::vector<Cost> costs_of(const std::vector<std::filesystem::path>& timings, const CostTableConfig& config) {
  // One stage and object lies in several folders; a folder that everything lies in tells nothing apart.
  const std::filesystem::path root = common_folder(timings);
  std::vector<StageTimings> read;
  for (const auto& file : timings) read.push_back(read_timings(file));
  std::vector<Cost> costs;
  for (const CostTableConfig::Row& row : config.rows) {
    Cost cost{.name = row.name, .per = row.per, .processor_s = {}};
    std::vector<double> seconds;
    for (std::size_t i = 0; i < timings.size(); ++i) {
      if (read[i].stage != row.stage || (!row.folder.empty() && !lies_in(timings[i], row.folder, root))) continue;
      seconds.push_back(read[i].processor_s);
      cost.largest_s = std::max(cost.largest_s, read[i].processor_s);
      cost.peak_memory_mb = std::max(cost.peak_memory_mb, read[i].peak_memory_mb);
    }
    if (seconds.empty())
      throw DataError("no timings of {}{} were given for '{}'", row.stage,
                      row.folder.empty() ? "" : " in " + row.folder, row.name);
    cost.runs = seconds.size();
    cost.processor_s = mean_and_deviation(seconds);
    costs.push_back(cost);
  }
  return costs;
}

std::vector<CostSum> sums_of(const std::vector<Cost>& costs, const CostTableConfig& config) {
  std::vector<CostSum> sums;
  for (const CostTableConfig::Sum& wanted : config.sums) {
    CostSum sum{.name = wanted.name, .per = wanted.per};
    for (const Cost& cost : costs) {
      if (std::find(wanted.of.begin(), wanted.of.end(), cost.name) == wanted.of.end()) continue;
      sum.processor_s += cost.processor_s.mean;
      sum.peak_memory_mb = std::max(sum.peak_memory_mb, cost.peak_memory_mb);
    }
    sums.push_back(sum);
  }
  return sums;
}

std::string to_markdown(const std::vector<Cost>& costs, const CostTableConfig& config) {
  std::string text =
      fmt::format("| {} | for each | runs | processor, s | largest, s | peak memory, GB |\n|---|---|---|---|---|---|\n",
                  config.title);
  for (const Cost& cost : costs)
    text += fmt::format("| {} | {} | {} | {:.1f} ± {:.1f} | {:.1f} | {:.2f} |\n", cost.name, cost.per, cost.runs,
                        cost.processor_s.mean, cost.processor_s.deviation, cost.largest_s, 1e-3 * cost.peak_memory_mb);
  for (const CostSum& sum : sums_of(costs, config))
    text += fmt::format("| **{}** | {} | | {:.1f} | | {:.2f} |\n", sum.name, sum.per, sum.processor_s,
                        1e-3 * sum.peak_memory_mb);
  if (!config.caption.empty()) text += "\n" + config.caption + (config.caption.ends_with('\n') ? "" : "\n");
  return text;
}

std::string to_csv(const std::vector<Cost>& costs) {
  std::string text = csv_line({"row", "per", "runs", "processor_s", "deviation_s", "largest_s", "peak_memory_mb"});
  for (const Cost& cost : costs)
    text += csv_line({cost.name, cost.per, fmt::format("{}", cost.runs), fmt::format("{}", cost.processor_s.mean),
                      fmt::format("{}", cost.processor_s.deviation), fmt::format("{}", cost.largest_s),
                      fmt::format("{}", cost.peak_memory_mb)});
  return text;
}

}  // namespace tacipc
