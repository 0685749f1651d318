#include "stages/study/tabulate/comparison.h"

#include <fmt/core.h>

#include <filesystem>
#include <set>

#include "common/base/error.h"
#include "stages/study/tabulate/markdown.h"

namespace tacipc {
namespace {

const std::vector<ShownColumn> kColumns{{.column = "ssim_s", .heading = "SSIM-S", .digits = 3},
                                        {.column = "ssim_w", .heading = "SSIM-W", .digits = 3},
                                        {.column = "mae", .heading = "MAE", .digits = 4},
                                        {.column = "psnr_db", .heading = "PSNR dB", .digits = 2}};
const std::vector<ShownRegion> kRegions{{.region = "box", .heading = ""},
                                        {.region = "full", .heading = "whole image: "}};

/// Appends the headings of the columns; `words` precede the first.
void add_headings(std::vector<std::string>& headings, const std::string& words) {
  for (const ShownColumn& column : kColumns)
    headings.push_back(fmt::format("{}{}", &column == &kColumns.front() ? words : "", column.heading));
}

template <typename ValueOf>
void add_cells(std::vector<std::string>& cells, const ValueOf& value_of) {
  for (const ShownColumn& column : kColumns) cells.push_back(markdown_number(value_of(column.column), column.digits));
}

/// Index of the benchmark's image among the measured ones, whose names have folders and an ending.
std::size_t place_of(const MethodScores& method, const std::string& image) {
  for (std::size_t i = 0; i < method.images.size(); ++i)
    if (std::filesystem::path(method.images[i]).stem() == image) return i;
  throw DataError("row '{}': {} was not measured", method.row.name, image);
}

std::string remark(const PhotographCase& image, const ObjectCase& object) {
  const bool place = image.name == object.fit_image;
  if (image.name == object.calibrates) return place ? " (calibrates, place; in no mean)" : " (calibrates; in no mean)";
  return place ? " (fitted place)" : "";
}

}  // namespace

ComparisonConfig ComparisonConfig::read(ConfigReader& in) {
  ComparisonConfig config;
  for (ConfigReader& item : in.sections("rows"))
    config.rows.push_back({.name = item.text("name"), .method = item.text("method"), .group = ""});
  if (config.rows.size() < 2) in.fault("rows", "needs at least two: the one judged and another");
  return config;
}

std::vector<MethodScores> read_comparison(const std::vector<NamedPath>& tables, const ComparisonConfig& config,
                                          const BenchmarkCases& cases) {
  std::set<std::string> calibrating;
  for (const ObjectCase& object : cases.objects)
    if (!object.calibrates.empty()) calibrating.insert(object.calibrates);
  auto methods = read_methods(tables, config.rows, kRegions, kColumns, calibrating);
  for (const MethodScores& method : methods)
    if (method.runs > 1) throw DataError("{}: a comparison takes one table for each method", method.row.method);
  std::size_t images = 0;
  for (const ObjectCase& object : cases.objects) {
    images += object.images.size();
    for (const PhotographCase& image : object.images) place_of(methods.front(), image.name);
  }
  if (images != methods.front().images.size())
    throw DataError("{} images were measured, the benchmark has {}", methods.front().images.size(), images);
  return methods;
}

Verdict judge(const std::vector<MethodScores>& methods, const BenchmarkCases& cases) {
  const auto box = [](const MethodScores& method, const char* column) { return method.cell("box", column).mean; };
  const MethodScores& ours = methods.front();
  const auto& must = cases.must;
  Verdict verdict{.musts = !must || (box(ours, "ssim_s") >= (*must)[0] && box(ours, "mae") <= (*must)[1] &&
                                     box(ours, "psnr_db") >= (*must)[2]),
                  .ahead = true};
  for (std::size_t m = 1; m < methods.size(); ++m)
    verdict.ahead = verdict.ahead && box(ours, "ssim_s") > box(methods[m], "ssim_s") &&
                    box(ours, "mae") < box(methods[m], "mae") && box(ours, "psnr_db") > box(methods[m], "psnr_db");
  return verdict;
}

std::string to_markdown(const std::vector<MethodScores>& methods, const BenchmarkCases& cases) {
  const Verdict verdict = judge(methods, cases);
  std::vector<std::string> headings{markdown_cell(cases.title)};
  for (const ShownRegion& region : kRegions) add_headings(headings, region.heading);
  std::string text = markdown_head(headings);
  for (const MethodScores& method : methods) {
    std::vector<std::string> cells{markdown_cell(method.row.name)};
    for (const auto& [region, heading] : kRegions)
      add_cells(cells, [&, &in = region](const std::string& column) { return method.cell(in, column).mean; });
    text += markdown_row(cells);
  }
  text +=
      fmt::format("\nMeans over {} photographs; the first four columns in the contact box. ", methods.front().counted);
  if (const auto& must = cases.must)
    text += fmt::format("Required of the first row there: SSIM-S {}, MAE {}, PSNR {} dB{}; ahead of ", (*must)[0],
                        (*must)[1], (*must)[2], verdict.musts ? " (holds)" : " (**missed**)");
  else
    text += "The first row there is ahead of ";
  text += fmt::format("every other row on {}: {}.\n", cases.must ? "the three" : "SSIM-S, MAE and PSNR",
                      verdict.ahead ? "yes" : "**no**");
  headings = {"image, in the box"};
  for (const MethodScores& method : methods) add_headings(headings, markdown_cell(method.row.name) + ": ");
  text += '\n';
  text += markdown_head(headings);
  for (const ObjectCase& object : cases.objects)
    for (const PhotographCase& image : object.images) {
      std::vector<std::string> cells{image.name + remark(image, object)};
      for (const MethodScores& method : methods)
        add_cells(cells, [&, i = place_of(method, image.name)](const std::string& column) {
          return method.cell("box", column).values[i];
        });
      text += markdown_row(cells);
    }
  return text;
}

Value::Map summary_of(const std::vector<MethodScores>& methods, const BenchmarkCases& cases) {
  const Verdict verdict = judge(methods, cases);
  Value::Map summary{{"holds", verdict.musts && verdict.ahead}, {"musts", verdict.musts}, {"ahead", verdict.ahead}};
  for (const MethodScores& method : methods) {
    Value::Map regions;
    for (const auto& [region, heading] : kRegions) {
      Value::Map means;
      for (const ShownColumn& column : kColumns)
        means.emplace_back(column.column, method.cell(region, column.column).mean);
      regions.emplace_back(region, std::move(means));
    }
    summary.emplace_back(method.row.name, std::move(regions));
  }
  return summary;
}

}  // namespace tacipc
