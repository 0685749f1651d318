#include <fmt/core.h>

#include <cctype>

#include "common/format/html_text.h"
#include "stages/dataset/report/chart.h"
#include "stages/dataset/report/dataset/coverage_svg.h"
#include "stages/dataset/report/dataset/overview.h"
#include "stages/dataset/report/dataset/site.h"
#include "stages/dataset/report/html.h"

namespace tacipc {
namespace {

constexpr int kBins = 24, kColumns = 60, kRows = 42;
/// Limit of drawn rows; further rows are only in the table.
constexpr std::size_t kDrawnRows = 24;

constexpr const char* kHowToRead =
    "<p>A line from the smallest to the largest value, a bar from the 5th to the 95th percentile, a mark at the "
    "median.</p>\n";

std::string capital(std::string words) {
  words[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(words[0])));
  return words;
}

/// Names of existing splits: train, validation, test.
std::vector<std::string> split_names(const std::map<std::string, std::vector<double>>& values) {
  std::vector<std::string> names;
  for (const char* name : {"train", "val", "test"})
    if (values.contains(name)) names.emplace_back(name);
  for (const auto& [name, list] : values)
    if (name != "train" && name != "val" && name != "test") names.push_back(name);
  return names;
}

std::string histogram_figure(const DatasetTally& tally, std::size_t q) {
  const Quantity& quantity = kQuantities[q];
  const auto values = tally.values(q, "split");
  const std::vector<std::string> names = split_names(values);
  std::vector<std::vector<double>> groups;
  std::vector<double> all;
  for (const std::string& name : names) {
    groups.push_back(values.at(name));
    all.insert(all.end(), groups.back().begin(), groups.back().end());
  }
  const auto spread = spread_of(all);
  if (!spread) return "";
  std::string caption = fmt::format("<b>{}</b>: {}<span class=\"keys\">", capital(quantity.label()), quantity.meaning);
  for (std::size_t g = 0; g < names.size(); ++g)
    caption += fmt::format("<span>{}{}</span>", curve_key(static_cast<int>(g) + 1), html_text(names[g]));
  caption += fmt::format("</span>{} samples, median {}, nine tenths between {} and {}", count_text(spread->count),
                         number_text(spread->median), number_text(spread->p5), number_text(spread->p95));
  const std::string what =
      fmt::format("{} of {} samples, from {} to {}, median {}", quantity.label(), spread->count,
                  number_text(spread->low), number_text(spread->high), number_text(spread->median));
  return figure(histogram_svg(histogram(groups, kBins), names, what, quantity.label()), caption);
}

std::string pair_figure(const DatasetTally& tally, std::size_t x, std::size_t y) {
  const auto [first, second] = tally.pairs(x, y);
  if (first.empty()) return "";
  const std::string x_label = kQuantities[x].label(), y_label = kQuantities[y].label();
  const PairMap map = pair_map(first, second, kColumns, kRows, 7);
  return figure(pair_map_svg(map, y_label + " over " + x_label, x_label, y_label),
                fmt::format("<b>{}</b> over {}; the fullest cell has {} of {} samples", capital(kQuantities[y].name),
                            kQuantities[x].name, count_text(map.largest()), count_text(first.size())));
}

std::vector<std::pair<std::string, Spread>> spreads_by(const DatasetTally& tally, std::size_t q,
                                                       const std::string& column) {
  std::vector<std::pair<std::string, Spread>> rows;
  for (const auto& [word, values] : tally.values(q, column))
    if (const auto spread = spread_of(values)) rows.emplace_back(word, *spread);
  return rows;
}

/// Table with one row per object, and for each quantity the median and the inner nine tenths.
std::string objects_table(const DatasetTally& tally) {
  std::map<std::string, std::vector<std::string>> cells;
  for (std::size_t q = 0; q < kQuantities.size(); ++q) {
    for (const auto& [word, spread] : spreads_by(tally, q, "object")) {
      auto& row = cells[word];
      row.resize(kQuantities.size(), "–");
      row[q] = fmt::format("{} <span class=\"quiet\">({} to {})</span>", number_text(spread.median),
                           number_text(spread.p5), number_text(spread.p95));
    }
  }
  std::string table = "<details><summary>Numbers by object: median (5th to 95th percentile)</summary>" +
                      scroll_start("Numbers by object") + "<table>\n<thead><tr><th class=\"word\">object</th>";
  for (const Quantity& quantity : kQuantities) table += "<th>" + quantity.label() + "</th>";
  table += "</tr></thead>\n<tbody>\n";
  for (const auto& [object, row] : cells) {
    table += "<tr><td class=\"word\">" + html_text(object) + "</td>";
    for (const std::string& cell : row) table += "<td>" + cell + "</td>";
    table += "</tr>\n";
  }
  return table + "</tbody></table></div></details>\n";
}

/// Drawing per quantity with a row per word of the column; none if there are too many words to draw.
std::string spreads_figures(const DatasetTally& tally, const std::string& column) {
  std::string html;
  for (std::size_t q = 0; q < kQuantities.size(); ++q) {
    const auto rows = spreads_by(tally, q, column);
    if (rows.empty()) continue;
    if (rows.size() > kDrawnRows) return fmt::format("<p>{} of them: too many to draw.</p>\n", count_text(rows.size()));
    const std::string label = kQuantities[q].label();
    html += figure(spreads_svg(rows, label + " by " + column, label),
                   "<b>" + capital(label) + "</b>: " + kQuantities[q].meaning);
  }
  return "<div class=\"plots\">\n" + html + "</div>\n";
}

}  // namespace

std::string coverage_section(const DatasetTally& tally) {
  std::string html = "<section id=\"coverage\">\n<h2>Coverage</h2>\n";
  const std::size_t made = tally.all[SampleStatus::made];
  if (made == 0) return html + "<p>No sample is made yet.</p>\n</section>\n";
  html += fmt::format(
      "<p>Of all {} made samples. Each number is the largest over the frames of its sample; splits are by object.</p>\n"
      "<div class=\"plots\">\n",
      count_text(made));
  for (std::size_t q = 0; q < kQuantities.size(); ++q) html += histogram_figure(tally, q);
  html += pair_figure(tally, kDepth, kShearRatio) + pair_figure(tally, kDepth, kArea) +
          pair_figure(tally, kTwist, kShearRatio) + pair_figure(tally, kDepth, kPressForce);
  return html + "</div>\n<h3 class=\"over\">By motion</h3>\n" + kHowToRead + spreads_figures(tally, "motion") +
         "<h3 class=\"over\">By object</h3>\n" + spreads_figures(tally, "object") + objects_table(tally) +
         "</section>\n";
}

}  // namespace tacipc
