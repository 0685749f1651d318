#include "stages/study/tabulate/image_table_config.h"

#include <algorithm>

#include "common/benchmark/benchmark_cases.h"

namespace tacipc {
namespace {

/// Reports a second item with the same value of `member`.
template <typename Item>
void refuse_repeats(ConfigReader& in, const std::string& key, const std::vector<Item>& items,
                    std::string Item::*member) {
  if (std::ranges::count(items, items.back().*member, member) > 1) in.fault(key, "is given twice");
}

template <typename Item>
void must_be_one_of(ConfigReader& in, const std::string& key, const std::string& value, const std::vector<Item>& items,
                    std::string Item::*member, const std::string& what) {
  if (std::ranges::none_of(items, [&](const Item& item) { return item.*member == value; }))
    in.fault(key, "is not one of the " + what);
}

PrintedRows read_printed(ConfigReader in, const ImageTableConfig& config) {
  PrintedRows printed{.label = in.text("label"), .source = in.text("source"), .region = in.text("region"), .rows = {}};
  must_be_one_of(in, "region", printed.region, config.regions, &ShownRegion::region, "regions");
  for (ConfigReader& item : in.one_or_more_sections("rows")) {
    PrintedRow row{.name = item.text("name"), .values = {}};
    ConfigReader values = item.section("values");
    for (const std::string& column : values.keys()) {
      values.number(column);  // checks that it is a number; the text keeps its digits
      row.values.emplace_back(column, values.text(column));
      must_be_one_of(values, column, column, config.columns, &ShownColumn::column, "columns");
    }
    printed.rows.push_back(std::move(row));
  }
  return printed;
}

Finding read_finding(ConfigReader& in, const ImageTableConfig& config) {
  Finding finding{.region = in.text("region"),
                  .column = in.text("column"),
                  .row = in.text("row"),
                  .against = in.text("against"),
                  .below = in.text("below"),
                  .above = in.text("above"),
                  .variants = in.has("variants") ? in.texts("variants") : std::vector<std::string>{}};
  must_be_one_of(in, "region", finding.region, config.regions, &ShownRegion::region, "regions");
  must_be_one_of(in, "column", finding.column, config.columns, &ShownColumn::column, "columns");
  must_be_one_of(in, "row", finding.row, config.rows, &MeasuredRow::method, "rows' methods");
  must_be_one_of(in, "against", finding.against, config.rows, &MeasuredRow::method, "rows' methods");
  for (const std::string& variant : finding.variants)
    must_be_one_of(in, "variants", variant, config.rows, &MeasuredRow::method, "rows' methods");
  return finding;
}

SheetConfig read_sheet(ConfigReader& in) {
  constexpr int kWidest = 4096;
  SheetConfig sheet{.name = in.text("name"),
                    .alt = in.text("alt"),
                    .crop_px = std::nullopt,
                    .picture_px = in.integer("picture_px", 8, kWidest),
                    .columns = {}};
  if (sheet.name.find('/') != std::string::npos) in.fault("name", "must be a file's name, not a path");
  if (in.has("crop_px")) sheet.crop_px = pixel_box(in, "crop_px");
  for (ConfigReader& item : in.one_or_more_sections("columns")) {
    sheet.columns.push_back({.heading = item.text("heading"), .method = item.text("method")});
    refuse_repeats(item, "method", sheet.columns, &SheetColumn::method);
  }
  return sheet;
}

}  // namespace

std::optional<std::string> PrintedRow::value(const std::string& column) const {
  for (const auto& [key, number] : values)
    if (key == column) return number;
  return std::nullopt;
}

ImageTableConfig ImageTableConfig::read(ConfigReader& in) {
  ImageTableConfig config;
  config.title = in.text("title");
  config.caption = in.text_or("caption", "");
  config.link_folder = in.text_or("link_folder", "");
  for (ConfigReader& item : in.one_or_more_sections("columns")) {
    config.columns.push_back(
        {.column = item.text("column"),
         .heading = item.text("heading"),
         .digits = item.integer("digits", 0, 9),
         .geometric = item.choice_or("mean", "arithmetic", {"arithmetic", "geometric"}) == "geometric"});
    refuse_repeats(item, "column", config.columns, &ShownColumn::column);
  }
  for (ConfigReader& item : in.one_or_more_sections("regions")) {
    config.regions.push_back({.region = item.choice("region", {"full", "crop", "box", "pressed", "contact", "beside"}),
                              .heading = item.text("heading")});
    refuse_repeats(item, "region", config.regions, &ShownRegion::region);
  }
  config.uncounted = in.texts("uncounted");
  for (ConfigReader& item : in.one_or_more_sections("rows")) {
    MeasuredRow row{.name = item.text("name"), .method = item.text("method"), .group = item.text_or("group", "")};
    row.timed_as = item.text_or("timed_as", row.method);
    config.rows.push_back(std::move(row));
    refuse_repeats(item, "method", config.rows, &MeasuredRow::method);
  }
  if (auto printed = in.optional_section("printed")) config.printed = read_printed(*printed, config);
  for (ConfigReader& item : in.sections("findings")) config.findings.push_back(read_finding(item, config));
  for (ConfigReader& item : in.sections("sheets")) {
    config.sheets.push_back(read_sheet(item));
    refuse_repeats(item, "name", config.sheets, &SheetConfig::name);
  }
  return config;
}

}  // namespace tacipc
