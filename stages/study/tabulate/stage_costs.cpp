#include "stages/study/tabulate/stage_costs.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/format/csv.h"
#include "common/stage/stage_timings.h"
#include "stages/study/tabulate/markdown.h"

namespace tacipc {
namespace {

/// True if a folder on the path below `root` has this name, or ends with it after a hyphen (`mctac-adaptive_0100um`).
/// \pre the path begins with `root`, as for common_folder
bool lies_in(const std::filesystem::path& path, const std::string& folder, const std::filesystem::path& root) {
  const std::filesystem::path folders = path.parent_path();
  const auto below = std::next(folders.begin(), std::distance(root.begin(), root.end()));
  return std::any_of(below, folders.end(), [&](const std::filesystem::path& part) {
    return part == folder || part.string().ends_with("-" + folder);
  });
}

}  // namespace

StageCostsConfig StageCostsConfig::read(ConfigReader& in) {
  StageCostsConfig config{.title = in.text("title"), .caption = in.text_or("caption", ""), .rows = {}, .sums = {}};
  for (ConfigReader& item : in.one_or_more_sections("rows"))
    config.rows.push_back({.name = item.text("name"),
                           .stage = item.text("stage"),
                           .folder = item.text_or("folder", ""),
                           .per = item.text("per")});
  for (ConfigReader& item : in.sections("sums")) {
    StageCostsConfig::Sum sum{.name = item.text("name"), .per = item.text("per"), .of = item.texts("of")};
    for (const std::string& name : sum.of)
      if (std::ranges::none_of(config.rows, [&](const auto& row) { return row.name == name; }))
        item.fault("of", "'" + name + "' is not one of the rows");
    config.sums.push_back(std::move(sum));
  }
  return config;
}

std::vector<Cost> costs_of(const std::vector<std::filesystem::path>& timings, const StageCostsConfig& config) {
  // Results of one stage and object lie in several folders; their common folder distinguishes nothing.
  const std::filesystem::path root = common_folder(timings);
  std::vector<StageTimings> read;
  for (const auto& file : timings) read.push_back(read_timings(file));
  std::vector<Cost> costs;
  for (const StageCostsConfig::Row& row : config.rows) {
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

std::string to_markdown(const std::vector<Cost>& costs, const StageCostsConfig& config) {
  std::string text =
      markdown_head({markdown_cell(config.title), "for each", "runs", "processor, s", "largest, s", "peak memory, GB"});
  for (const Cost& cost : costs)
    text += markdown_row({markdown_cell(cost.name), markdown_cell(cost.per), fmt::format("{}", cost.runs),
                          markdown_deviation(cost.processor_s.mean, cost.processor_s.deviation, 1),
                          markdown_number(cost.largest_s, 1), markdown_number(1e-3 * cost.peak_memory_mb, 2)});
  for (const StageCostsConfig::Sum& sum : config.sums) {
    double seconds = 0.0, peak_mb = 0.0;
    for (const Cost& cost : costs) {
      if (std::ranges::find(sum.of, cost.name) == sum.of.end()) continue;
      seconds += cost.processor_s.mean;
      peak_mb = std::max(peak_mb, cost.peak_memory_mb);
    }
    text += markdown_row({"**" + markdown_cell(sum.name) + "**", markdown_cell(sum.per), "",
                          markdown_number(seconds, 1), "", markdown_number(1e-3 * peak_mb, 2)});
  }
  return text + markdown_paragraph(config.caption);
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
