#include <fmt/core.h>

#include <numeric>
#include <set>

#include "common/format/html_text.h"
#include "stages/dataset/report/dataset/overview.h"
#include "stages/dataset/report/dataset/site.h"
#include "stages/dataset/report/html.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

std::string number_cell(std::size_t count) {
  return "<td>" + (count == 0 ? std::string("–") : count_text(count)) + "</td>";
}

std::string share_bar(const StatusCounts& counts) {
  std::string bar = "<td><span class=\"share\" aria-hidden=\"true\">";
  for (const SampleStatus status : {SampleStatus::made, SampleStatus::failed, SampleStatus::running}) {
    const double part = 100.0 * static_cast<double>(counts[status]) / static_cast<double>(counts.total());
    if (part > 0) bar += fmt::format("<i class=\"{}\" style=\"width: {:.4g}%\"></i>", status_word(status), part);
  }
  return bar + "</span></td>";
}

std::string counts_table(const std::string& column, const std::map<std::string, StatusCounts>& rows) {
  constexpr std::size_t kTall = 14;
  std::string table = fmt::format("<div><h3>By {}</h3>{}<table>\n<thead><tr><th class=\"word\">{}</th><th>planned</th>",
                                  column, scroll_start("Samples by " + column), column);
  if (rows.size() > kTall) table.insert(table.find("class=\"scroll\"") + 7, "tall ");
  table += "<th>made</th><th>failed</th><th>running</th><th>not made</th><th></th></tr></thead>\n<tbody>\n";
  for (const auto& [word, counts] : rows) {
    table += "<tr><td class=\"word\">" + html_text(word) + "</td>" + number_cell(counts.total());
    for (const SampleStatus status :
         {SampleStatus::made, SampleStatus::failed, SampleStatus::running, SampleStatus::unmade})
      table += number_cell(counts[status]);
    table += share_bar(counts) + "</tr>\n";
  }
  return table + "</tbody></table></div></div>\n";
}

std::string log_cell(const fs::path& log, const fs::path& folder) {
  if (!fs::is_regular_file(log)) return "<td class=\"word\">–</td>";
  return fmt::format("<td class=\"word\"><a href=\"{}\">{}</a></td>", html_link(log, folder),
                     html_text(log.filename().string()));
}

std::string cost_row(const std::string& stage, const CostColumn& costs) {
  const auto wall = spread_of(costs.wall_s), processor = spread_of(costs.processor_s),
             memory = spread_of(costs.memory_mb);
  if (!processor) return "";
  std::string row =
      fmt::format("<tr><td class=\"word\">{}</td><td>{}</td>", html_text(stage), count_text(processor->count));
  for (const double value : {processor->mean, processor->median, processor->p95, processor->high, wall->mean,
                             memory->mean, memory->p95, memory->high})
    row += "<td>" + number_text(value) + "</td>";
  const double hours = processor->sum / 3600.0;
  return row + "<td>" + (hours < 0.001 ? "&lt; 0.001" : number_text(hours)) + "</td></tr>\n";
}

double core_hours(const CostColumn& costs) {
  return std::accumulate(costs.processor_s.begin(), costs.processor_s.end(), 0.0) / 3600.0;
}

}  // namespace

std::string counts_section(const DatasetTally& tally) {
  std::string html = "<section id=\"counts\">\n<h2>Samples</h2>\n<div class=\"tables\">\n";
  for (const char* column : {"split", "pose split", "motion", "gel", "outcome", "reason", "object"}) {
    const auto rows = tally.counts.find(column);
    if (rows != tally.counts.end()) html += counts_table(column, rows->second);
  }
  return html + "</div>\n</section>\n";
}

std::string failures_section(const Overview& overview) {
  const DatasetTally& tally = overview.tally;
  std::string html = "<section id=\"failures\">\n<h2>Failures</h2>\n";
  const std::size_t failed = tally.all[SampleStatus::failed];
  const fs::path ledger = overview.dataset / "failures.csv";
  if (failed == 0) {
    html += "<p>No sample stands as failed.";
  } else {
    html += fmt::format("<p>{} of {} samples failed: ", count_text(failed), count_text(tally.all.total()));
    std::string kinds;
    for (const auto& [kind, count] : tally.failures_by_kind)
      kinds += fmt::format("{}{} × {}", kinds.empty() ? "" : ", ", count, html_text(kind));
    html += kinds + ".";
  }
  if (fs::is_regular_file(ledger))
    html += fmt::format(" Every failed try, those made good later too: <a href=\"{}\">failures.csv</a>.",
                        html_link(ledger, overview.folder));
  html += "</p>\n";
  if (failed == 0) return html + "</section>\n";
  std::set<std::string> with_page;
  for (const SampleShot& shot : overview.shots) with_page.insert(shot.plan.id);
  if (tally.failures.size() < failed) html += fmt::format("<p>The first {} of them:</p>\n", tally.failures.size());
  html += scroll_start("Failed samples") +
          "<table>\n<thead><tr><th class=\"word\">sample</th><th class=\"word\">stage</th><th "
          "class=\"word\">reason</th><th class=\"word\">log</th></tr></thead>\n<tbody>\n";
  for (const auto& [plan, failure] : tally.failures) {
    const std::string id = html_text(plan.id);
    html += "<tr><td class=\"word\">";
    html += with_page.contains(plan.id)
                ? fmt::format("<a href=\"{}\">{}</a>", html_link(sample_page_name(plan.id), "."), id)
                : id;
    html += fmt::format("</td><td class=\"word\">{}</td><td class=\"wrap\">{}</td>", html_text(failure.stage),
                        html_text(failure.reason));
    html += log_cell(overview.dataset / plan.folder / failure.stage / (failure.stage + ".log"), overview.folder) +
            "</tr>\n";
  }
  return html + "</tbody></table></div>\n</section>\n";
}

std::string costs_section(const DatasetTally& tally, const std::vector<OtherCost>& others) {
  std::string html = "<section id=\"costs\">\n<h2>Time and memory</h2>\n";
  const double samples_h = core_hours(tally.press) + core_hours(tally.render);
  const std::size_t made = tally.all[SampleStatus::made];
  if (tally.press.processor_s.empty()) return html + "<p>Nothing has run yet.</p>\n</section>\n";
  double all_h = samples_h;
  for (const OtherCost& other : others) all_h += core_hours(other.costs);
  html += fmt::format("<p>{} core-hours in all, {} of them for samples", number_text(all_h), number_text(samples_h));
  if (made > 0 && samples_h > 0)
    html += fmt::format(": {} made samples per core-hour", number_text(static_cast<double>(made) / samples_h));
  html +=
      ". Processor seconds count all threads; wall seconds are those of the clock. Of a sample made more than once the "
      "last try counts.</p>\n";
  html +=
      scroll_start("Time and memory by stage") +
      "<table>\n<thead><tr><th class=\"word\">stage</th><th>runs</th><th>processor s<br>mean</th><th><br>median</th>"
      "<th><br>95 %</th><th><br>most</th><th>wall s<br>mean</th><th>memory MB<br>mean</th><th><br>95 %</th><th><br>"
      "most</th><th>core-hours<br>in all</th></tr></thead>\n<tbody>\n";
  html += cost_row("press", tally.press) + cost_row("render", tally.render);
  for (const OtherCost& other : others) html += cost_row(other.stage, other.costs);
  return html + "</tbody></table></div>\n</section>\n";
}

}  // namespace tacipc
