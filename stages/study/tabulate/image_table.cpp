#include "stages/study/tabulate/image_table.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/base/error.h"
#include "common/format/csv.h"
#include "stages/study/tabulate/markdown.h"

namespace tacipc {
namespace {

/// Line with the name of a group, between rows of its table.
std::string group_line(const std::string& group, std::size_t columns) {
  std::string text = "| **" + markdown_cell(group) + "** |";
  for (std::size_t i = 0; i < columns; ++i) text += "  |";
  return text + "\n";
}

/// Width and height of the images whose speed was measured, in the order of the file.
std::vector<std::array<int, 2>> sizes_of(const std::vector<ImageSpeed>& speeds) {
  std::vector<std::array<int, 2>> sizes;
  for (const ImageSpeed& speed : speeds) {
    const std::array<int, 2> size{speed.width_px, speed.height_px};
    if (std::ranges::find(sizes, size) == sizes.end()) sizes.push_back(size);
  }
  return sizes;
}

/// Cost of an image of a method; empty if it was not timed.
std::string speed_cell(const std::vector<ImageSpeed>& speeds, const std::string& method,
                       const std::array<int, 2>& size) {
  for (const ImageSpeed& speed : speeds)
    if (speed.method == method && speed.width_px == size[0] && speed.height_px == size[1]) return speed.total();
  return "";
}

std::string region_table(const ShownRegion& region, const std::vector<MethodScores>& rows,
                         const ImageTableConfig& config, const std::vector<ImageSpeed>& speeds) {
  const auto sizes = sizes_of(speeds);
  const std::size_t width = config.columns.size() + sizes.size();
  std::vector<std::string> headings{markdown_cell(region.heading)};
  for (const ShownColumn& column : config.columns) headings.push_back(markdown_cell(column.heading));
  for (const auto& [across, down] : sizes) headings.push_back(fmt::format("CPU ms, {} × {}", across, down));
  std::string text = markdown_head(headings), group;
  for (const MethodScores& row : rows) {
    if (row.row.group != group && !row.row.group.empty()) text += group_line(row.row.group, width);
    group = row.row.group;
    std::vector<std::string> cells{markdown_cell(row.row.name)};
    for (const ShownColumn& column : config.columns) {
      const MeanDeviation& cell = row.cell(region.region, column.column);
      cells.push_back(markdown_deviation(cell.mean, cell.deviation, column.digits, column.geometric ? "×÷" : "±"));
    }
    for (const auto& size : sizes) cells.push_back(speed_cell(speeds, row.row.timed_as, size));
    text += markdown_row(cells);
  }
  if (!config.printed || config.printed->region != region.region) return text;
  text += group_line(config.printed->label, width);
  for (const PrintedRow& row : config.printed->rows) {
    std::vector<std::string> cells{markdown_cell(row.name)};
    for (const ShownColumn& column : config.columns) cells.push_back(row.value(column.column).value_or("–"));
    cells.resize(1 + width);
    text += markdown_row(cells);
  }
  return text;
}

const MethodScores& row_in(const std::vector<MethodScores>& rows, const std::string& method) {
  return *std::ranges::find_if(rows, [&](const MethodScores& row) { return row.row.method == method; });
}

template <typename Item>
const std::string& heading_of(const std::vector<Item>& items, std::string Item::*member, const std::string& value) {
  return std::ranges::find_if(items, [&](const Item& item) { return item.*member == value; })->heading;
}

std::string named(const MeasuredRow& row) {
  return markdown_cell(row.name) + (row.group.empty() ? "" : " (" + markdown_cell(row.group) + ")");
}

/// Number of a column on the scale of its differences: the logarithm if its mean is geometric.
double value_of(double number, const Finding& finding, const ImageTableConfig& config) {
  const auto column = std::ranges::find(config.columns, finding.column, &ShownColumn::column);
  return column->geometric ? std::log(number) : number;
}

/// Difference of two rows with several runs, in units of its standard deviation between single runs, √(s₁² + s₂²) with
/// s² = Σ (mean of a run − mean of all)² / (runs − 1); by logarithms for geometric columns. Nothing for single runs, or
/// if all runs agree.
std::optional<double> difference_in_deviations(const MethodScores& row, const MethodScores& against,
                                               const Finding& finding, const ImageTableConfig& config) {
  if (row.runs == 1 || against.runs == 1) return std::nullopt;
  const auto value = [&](double number) { return value_of(number, finding, config); };
  const auto mean_of = [&](const MethodScores& of) { return value(of.cell(finding.region, finding.column).mean); };
  const auto deviation_of = [&](const MethodScores& of) {
    const auto runs = static_cast<double>(of.runs);
    return value(of.cell(finding.region, finding.column).deviation) * std::sqrt(runs / (runs - 1.0));
  };
  const double deviation = std::hypot(deviation_of(row), deviation_of(against));
  if (!(deviation > 0.0)) return std::nullopt;
  return std::abs(mean_of(row) - mean_of(against)) / deviation;
}

/// Smallest and largest mean among a finding's row and its variants.
std::pair<double, double> spread_of(const Finding& finding, const std::vector<MethodScores>& rows) {
  std::vector<double> means;
  for (const MethodScores& row : rows)
    if (row.row.method == finding.row || std::ranges::count(finding.variants, row.row.method) > 0)
      means.push_back(row.cell(finding.region, finding.column).mean);
  const auto [low, high] = std::ranges::minmax(means);
  return {low, high};
}

/// Sentence `- <region>, <column>: <row> 0.62 times <row>: <meaning>`.
std::string sentence(const Finding& finding, const std::vector<MethodScores>& rows, const ImageTableConfig& config) {
  constexpr double kClear = 2.0;  // standard deviations
  const MethodScores &row = row_in(rows, finding.row), &against = row_in(rows, finding.against);
  const double mean = row.cell(finding.region, finding.column).mean,
               other = against.cell(finding.region, finding.column).mean, ratio = mean / other;
  const bool same_group = row.row.group == against.row.group;
  std::string text =
      fmt::format("- {}, {}: {} has {} times that of {}",
                  markdown_cell(heading_of(config.regions, &ShownRegion::region, finding.region)),
                  markdown_cell(heading_of(config.columns, &ShownColumn::column, finding.column)), named(row.row),
                  markdown_number(ratio, 2), same_group ? markdown_cell(against.row.name) : named(against.row));
  std::string meaning = ratio < 1.0 ? finding.below : finding.above;
  if (!finding.variants.empty()) {
    const auto [low, high] = spread_of(finding, rows);
    text += fmt::format(" ({} to {} times with other settings)", markdown_number(low / other, 2),
                        markdown_number(high / other, 2));
    const auto value = [&](double number) { return value_of(number, finding, config); };
    if (!(std::abs(value(mean) - value(other)) > value(high) - value(low)))
      meaning = fmt::format("less than the settings change{}.",
                            high < other || low > other ? ", though with all of them on the same side" : "");
  }
  const auto deviations = difference_in_deviations(row, against, finding, config);
  if (!deviations) return text + ": " + meaning + "\n";
  text += fmt::format(", a difference of {} deviations between single runs: ", markdown_number(*deviations, 1));
  return text + (*deviations < kClear ? "not clear." : meaning) + "\n";
}

/// Number of runs of the rows that have several.
std::string of_runs(const std::vector<MethodScores>& rows) {
  std::vector<std::string> named;  // names already listed, for rows of one name in several groups
  for (const MethodScores& row : rows) {
    const std::string name = fmt::format("{} {}", markdown_cell(row.row.name), row.runs);
    if (row.runs > 1 && std::ranges::find(named, name) == named.end()) named.push_back(name);
  }
  return named.empty() ? ""
                       : fmt::format("; in rows of several runs, over the runs' means ({})", fmt::join(named, ", "));
}

}  // namespace

std::string to_markdown(const std::vector<MethodScores>& rows, const ImageTableConfig& config,
                        const std::vector<ImageSpeed>& speeds) {
  std::string text;
  for (const MethodScores& row : rows)
    if (!speeds.empty() && row.row.timed_as != row.row.method &&
        std::ranges::none_of(speeds, [&](const auto& s) { return s.method == row.row.timed_as; }))
      throw DataError("no speed was measured of {}, as which '{}' is timed", row.row.timed_as, row.row.name);
  for (const ShownRegion& region : config.regions)  // the cost of an image applies to all regions
    text +=
        region_table(region, rows, config, &region == &config.regions.front() ? speeds : std::vector<ImageSpeed>{}) +
        "\n";
  text += fmt::format("{}: mean ± standard deviation over {} images{}.", markdown_cell(config.title),
                      rows.front().counted, of_runs(rows));
  if (config.printed) text += fmt::format(" Printed numbers: {}.", config.printed->source);
  text += "\n";
  text += markdown_paragraph(config.caption);
  if (!config.findings.empty()) text += "\n";
  for (const Finding& finding : config.findings) text += sentence(finding, rows, config);
  for (const SheetConfig& sheet : config.sheets)
    text += markdown_picture(sheet.alt, config.link_folder, sheet.name + ".png");
  return text;
}

std::string to_csv(const std::vector<MethodScores>& rows, const ImageTableConfig& config) {
  std::string text = csv_line({"row", "group", "region", "column", "images", "runs", "mean", "std", "source"});
  for (const ShownRegion& region : config.regions)
    for (const MethodScores& row : rows)
      for (const ShownColumn& column : config.columns) {
        const MeanDeviation& cell = row.cell(region.region, column.column);
        text += csv_line({row.row.name, row.row.group, region.region, column.column, fmt::format("{}", row.counted),
                          fmt::format("{}", row.runs), fmt::format("{}", cell.mean), fmt::format("{}", cell.deviation),
                          ""});
      }
  if (!config.printed) return text;
  for (const PrintedRow& row : config.printed->rows)
    for (const auto& [column, value] : row.values)
      text += csv_line(
          {row.name, config.printed->label, config.printed->region, column, "", "", value, "", config.printed->source});
  return text;
}

}  // namespace tacipc
