#include "stages/dataset/report/dataset/dataset_report.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

#include "common/base/files.h"
#include "common/base/log.h"
#include "stages/dataset/report/dataset/list_pages.h"
#include "stages/dataset/report/dataset/overview.h"
#include "stages/dataset/report/dataset/report_config.h"
#include "stages/dataset/report/dataset/sample_page.h"
#include "stages/dataset/report/dataset/site.h"
#include "stages/dataset/report/dataset/tally.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Rows of the plan that are read in parallel.
constexpr std::size_t kBlock = 256;

/// Calls `use` for every block of the plan's rows, with the index of the first.
void for_each_block(const fs::path& plan, const std::function<void(const std::vector<PlannedRow>&, std::size_t)>& use) {
  std::vector<PlannedRow> block;
  std::size_t first = 0;
  const auto flush = [&] {
    if (!block.empty()) use(block, first);
    first += block.size();
    block.clear();
  };
  for_each_planned(plan, std::nullopt, [&](const PlannedRow& row) {
    block.push_back(row);
    if (block.size() == kBlock) flush();
  });
  flush();
}

/// State of a sample, and whether its images still exist.
struct SampleState {
  SampleStatus status = SampleStatus::unmade;
  bool images_dropped = false;
};

std::vector<SampleState> read_states(const fs::path& plan, const fs::path& dataset) {
  std::vector<SampleState> states;
  for_each_block(plan, [&](const std::vector<PlannedRow>& rows, std::size_t first) {
    states.resize(first + rows.size());
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
      const fs::path folder = dataset / rows[i].folder;
      states[first + i] = {status_of(folder), was_dropped(folder / "render")};
    });
  });
  return states;
}

/// Positions in the plan of the samples that get a page, ascending. Among the made ones those that still have images
/// are preferred.
std::vector<std::size_t> chosen_samples(const std::vector<SampleState>& states, const DatasetReportConfig& config) {
  std::vector<std::size_t> made, dropped, failed, chosen;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i].status == SampleStatus::made) (states[i].images_dropped ? dropped : made).push_back(i);
    if (states[i].status == SampleStatus::failed) failed.push_back(i);
  }
  const auto choose = [&](const std::vector<std::size_t>& among, int how_many) {
    for (const std::size_t i : evenly_chosen(among.size(), static_cast<std::size_t>(how_many)))
      chosen.push_back(among[i]);
  };
  choose(made.empty() ? dropped : made, config.made);
  choose(failed, config.failed);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<PlannedRow> rows_at(const fs::path& plan, const std::vector<std::size_t>& positions) {
  std::vector<PlannedRow> rows;
  std::size_t at = 0;
  for_each_planned(plan, std::nullopt, [&](const PlannedRow& row) {
    if (rows.size() < positions.size() && positions[rows.size()] == at) rows.push_back(row);
    ++at;
  });
  return rows;
}

/// Cost of a stage from timings in the dataset: dataset/<folder>/<any>/<below>/<stage>.timings.yaml.
OtherCost other_cost(const fs::path& dataset, const std::string& stage, const std::string& folder,
                     const std::string& below) {
  OtherCost cost{.stage = stage, .costs = {}};
  std::error_code none;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(dataset / folder, none))
    files.push_back(entry.path() / below / (stage + ".timings.yaml"));
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files)
    if (const auto found = timings_if_there(file)) cost.costs.add(*found);
  return cost;
}

std::vector<OtherCost> other_costs(const fs::path& dataset) {
  return {other_cost(dataset, "tetmesh", "gels", ""), other_cost(dataset, "emboss", "objects", "emboss"),
          other_cost(dataset, "wrap", "objects", "wrap"), other_cost(dataset, "decimate", "objects", ""),
          other_cost(dataset, "pack", "shards", "")};
}

/// Writes the pages of the chosen samples, some in parallel.
/// \return their entries for other pages
std::vector<SampleShot> write_sample_pages(Stage& stage, const fs::path& dataset, const std::string& name,
                                           const DatasetReportConfig& config, const std::vector<PlannedRow>& chosen) {
  constexpr std::size_t kSideBySide = 16;
  std::vector<SampleShot> shots;
  for (std::size_t first = 0; first < chosen.size(); first += kSideBySide) {
    show_progress(static_cast<double>(first) / static_cast<double>(chosen.size()), chosen[first].id);
    std::vector<SamplePage> pages(std::min(kSideBySide, chosen.size() - first));
    tbb::parallel_for(std::size_t{0}, pages.size(), [&](std::size_t i) {
      pages[i] = make_sample_page(chosen[first + i], dataset, stage.out(), config);
    });
    for (std::size_t i = 0; i < pages.size(); ++i) {
      const std::size_t at = first + i;
      for (const auto& [file, bytes] : pages[i].pictures) write_file(stage.output(file), bytes);
      const std::size_t row = std::stoul(chosen[at].index);
      write_file(stage.output(sample_page_name(chosen[at].id)),
                 sample_page_html(name, pages[i], at > 0 ? &chosen[at - 1] : nullptr,
                                  at + 1 < chosen.size() ? &chosen[at + 1] : nullptr,
                                  list_page_name(row / static_cast<std::size_t>(config.rows))));
      shots.push_back(pages[i].shot);
    }
  }
  return shots;
}

}  // namespace

void report_dataset(Stage& stage) {
  const auto config = stage.read_config<DatasetReportConfig>("--config");
  const fs::path plan = stage.input("--plan");
  const fs::path dataset = fs::absolute(plan).lexically_normal().parent_path().parent_path();
  const std::string& name = stage.option("--title");
  DatasetFacts facts = read_dataset_facts(name, stage.input("--dataset"));

  const std::vector<SampleState> states = read_states(plan, dataset);
  const std::vector<PlannedRow> chosen = rows_at(plan, chosen_samples(states, config));
  std::set<std::string> with_page;
  for (const PlannedRow& row : chosen) with_page.insert(row.id);

  DatasetTally tally(static_cast<std::size_t>(config.failed));
  ListPages list(name, states.size(), static_cast<std::size_t>(config.rows), with_page,
                 [&](const std::string& file, const std::string& html) { write_file(stage.output(file), html); });
  for_each_block(plan, [&](const std::vector<PlannedRow>& planned, std::size_t first) {
    show_progress(static_cast<double>(first) / static_cast<double>(states.size()), planned.front().id);
    std::vector<SampleRow> rows(planned.size());
    tbb::parallel_for(std::size_t{0}, planned.size(),
                      [&](std::size_t i) { rows[i] = read_row(planned[i], dataset, states[first + i].status); });
    for (const SampleRow& row : rows) {
      tally.add(row);
      list.add(row);
      if (row.status == SampleStatus::made && !facts.gels.contains(gel_of(row.plan)))
        facts.gels[gel_of(row.plan)] = read_gel_facts(dataset / row.plan.folder);
    }
  });
  list.finish();

  const std::vector<SampleShot> shots = write_sample_pages(stage, dataset, name, config, chosen);
  const auto per_sheet = static_cast<std::size_t>(config.sheet);
  for (std::size_t page = 0; page < pages_of(shots.size(), per_sheet); ++page)
    write_file(stage.output(sheet_page_name(page)), sheet_page(name, shots, page, per_sheet));
  write_file(stage.output("style.css"), site_style());
  write_file(stage.output("index.html"), overview_page({.facts = facts,
                                                        .tally = tally,
                                                        .others = other_costs(dataset),
                                                        .shots = shots,
                                                        .dataset = dataset,
                                                        .folder = stage.out()}));
  const StatusCounts& all = tally.all;
  stage.summarize({{"samples", all.total()},
                   {"made", all[SampleStatus::made]},
                   {"failed", all[SampleStatus::failed]},
                   {"running", all[SampleStatus::running]},
                   {"not_made", all[SampleStatus::unmade]},
                   {"sample_pages", shots.size()}});
  log_info("{} samples: {} made, {} failed, {} running, {} not made; {} have pages", all.total(),
           all[SampleStatus::made], all[SampleStatus::failed], all[SampleStatus::running], all[SampleStatus::unmade],
           shots.size());
}

}  // namespace tacipc
