#include "stages/image_table/table_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/csv.h"

namespace tacipc {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string number(double value, int digits) {
  if (std::isinf(value)) return "∞";
  return std::isnan(value) ? "–" : fmt::format("{:.{}f}", value, digits);
}

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string header(const ShownRegion& region, const ImageTableConfig& config) {
  std::vector<std::string> headings{escaped(region.heading)};
  std::string rule = "|---|";
  for (const ShownColumn& column : config.columns) {
    headings.push_back(escaped(column.heading));
    rule += "---|";
  }
  return line(headings) + rule + "\n";
}

std::string group_line(const std::string& group, std::size_t columns) {
  std::vector<std::string> cells(columns + 1);
  cells.front() = "**" + escaped(group) + "**";
  return line(cells);
}

std::string region_table(const ShownRegion& region, const std::vector<MethodRow>& rows,
                         const ImageTableConfig& config) {
  std::string text = header(region, config), group;
  for (const MethodRow& row : rows) {
    if (row.row.group != group && !row.row.group.empty()) text += group_line(row.row.group, config.columns.size());
    group = row.row.group;
    std::vector<std::string> cells{escaped(row.row.name)};
    for (const ShownColumn& column : config.columns) {
      const MeanDeviation& cell = row.cell(region.region, column.column);
      cells.push_back(number(cell.mean, column.digits) + (column.geometric ? " ×÷ " : " ± ") +
                      number(cell.deviation, column.digits));
    }
    text += line(cells);
  }
  if (!config.printed || config.printed->region != region.region) return text;
  text += group_line(config.printed->label, config.columns.size());
  for (const PrintedRow& row : config.printed->rows) {
    std::vector<std::string> cells{escaped(row.name)};
    for (const ShownColumn& column : config.columns) {
      const auto value = row.value(column.column);
      cells.push_back(value.value_or("–"));
    }
    text += line(cells);
  }
  return text;
}

const MethodRow& row_in(const std::vector<MethodRow>& rows, const std::string& folder) {
  return *std::find_if(rows.begin(), rows.end(), [&](const MethodRow& row) { return row.row.folder == folder; });
}

template <typename Item>
const std::string& heading_of(const std::vector<Item>& items, std::string Item::*member, const std::string& value) {
  return std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.*member == value; })->heading;
}

std::string named(const MeasuredRow& row) {
  return escaped(row.name) + (row.group.empty() ? "" : " (" + escaped(row.group) + ")");
}

/// `- <region>, <column>: <row> 0.62 times <row>: <what that means>`
std::string sentence(const Finding& finding, const std::vector<MethodRow>& rows, const ImageTableConfig& config) {
  const MethodRow &row = row_in(rows, finding.row), &against = row_in(rows, finding.against);
  const double ratio =
      row.cell(finding.region, finding.column).mean / against.cell(finding.region, finding.column).mean;
  const bool same_group = row.row.group == against.row.group;
  return fmt::format("- {}, {}: {} has {} times that of {}: {}\n",
                     escaped(heading_of(config.regions, &ShownRegion::region, finding.region)),
                     escaped(heading_of(config.columns, &ShownColumn::column, finding.column)), named(row.row),
                     number(ratio, 2), same_group ? escaped(against.row.name) : named(against.row),
                     ratio < 1.0 ? finding.below : finding.above);
}

}  // namespace

std::string to_markdown(const std::vector<MethodRow>& rows, const ImageTableConfig& config) {
  std::string text;
  for (const ShownRegion& region : config.regions) text += region_table(region, rows, config) + "\n";
  text +=
      fmt::format("{}: mean ± standard deviation over {} images.", escaped(config.title), rows.front().images.size());
  if (config.printed) text += fmt::format(" Printed numbers: {}.", config.printed->source);
  text += "\n";
  if (!config.caption.empty()) text += "\n" + config.caption + (config.caption.ends_with('\n') ? "" : "\n");
  if (!config.findings.empty()) text += "\n";
  for (const Finding& finding : config.findings) text += sentence(finding, rows, config);
  for (const SheetConfig& sheet : config.sheets)
    text += fmt::format("\n![{}]({}{}{}.png)\n", sheet.alt, config.link_folder, config.link_folder.empty() ? "" : "/",
                        sheet.name);
  return text;
}

std::string to_csv(const std::vector<MethodRow>& rows, const ImageTableConfig& config) {
  std::string text = csv_line({"row", "group", "region", "column", "images", "mean", "std", "source"});
  for (const ShownRegion& region : config.regions)
    for (const MethodRow& row : rows)
      for (const ShownColumn& column : config.columns) {
        const MeanDeviation& cell = row.cell(region.region, column.column);
        text +=
            csv_line({row.row.name, row.row.group, region.region, column.column, fmt::format("{}", row.images.size()),
                      fmt::format("{}", cell.mean), fmt::format("{}", cell.deviation), ""});
      }
  if (!config.printed) return text;
  for (const PrintedRow& row : config.printed->rows)
    for (const auto& [column, value] : row.values)
      text += csv_line(
          {row.name, config.printed->label, config.printed->region, column, "", value, "", config.printed->source});
  return text;
}

}  // namespace tacipc
