#include "tests/verification/table_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/config.h"

namespace tacipc::verify {
namespace {

/// The study's own table: every labelled quantity over its parameter, with its error against the finest.
std::string study_table(const std::string& name, std::vector<const ResultFile*> files) {
  std::sort(files.begin(), files.end(), [](const auto* a, const auto* b) { return a->study->value > b->study->value; });
  std::string out =
      fmt::format("### {}\n\n| {} | vertices | quantity | value | against the finest |\n|---|---|---|---|---|\n", name,
                  files.front()->study->parameter);
  std::map<std::string, std::vector<std::pair<double, double>>> curves;
  for (const ResultFile* file : files) {
    for (const ResultRow& row : file->rows) {
      const auto& finest = files.back()->rows;
      const auto match =
          std::find_if(finest.begin(), finest.end(), [&](const auto& r) { return r.label == row.label; });
      const std::string error =
          match == finest.end() || file == files.back()
              ? "–"
              : fmt::format("{:+.2f} %", 100.0 * (row.measured - match->measured) / std::abs(match->measured));
      out += fmt::format("| {:g} | {} | {} | {:.5g} {} | {} |\n", file->study->value, file->gel_vertices, row.label,
                         row.measured, row.unit, error);
      curves[row.label].emplace_back(file->study->value, row.measured);
    }
  }
  out += '\n';
  for (const auto& [label, points] : curves)
    if (const auto order = order_seen(points)) out += fmt::format("Order seen of {}: {:.1f}. ", label, *order);
  return out + "\n\n";
}

}  // namespace

ResultFile read_result(const std::filesystem::path& result_yaml) {
  ConfigReader in = ConfigReader::from_file(result_yaml);
  ResultFile file;
  file.name = result_yaml.parent_path().filename().string();
  file.title = in.text("title");
  file.source = in.text("source");
  file.state = in.choice("state", {"pass", "missed", "failed", "skipped"});
  file.reason = in.optional_text("reason");
  file.fitted_modulus_pa = in.optional_number("fitted_modulus_pa");
  file.gel_vertices = in.integer_or("gel_vertices", 0, 0);
  if (auto study = in.optional_section("study"))
    file.study = ResultFile::StudyPoint{study->text("name"), study->text("parameter"), study->number("value")};
  if (in.has("rows")) {
    for (ConfigReader& row : in.sections("rows")) {
      file.rows.push_back({.label = row.text("label"),
                           .unit = row.text("unit"),
                           .limit = row.text("limit"),
                           .measured = row.number("measured"),
                           .expected = row.optional_number("expected"),
                           .deviation = row.number("deviation"),
                           .pass = row.flag("pass")});
    }
  }
  in.finish();
  return file;
}

std::optional<double> order_seen(const std::vector<std::pair<double, double>>& points) {
  if (points.size() < 3) return std::nullopt;
  const double finest = points.back().second;
  const double first = std::abs(points[0].second - finest), second = std::abs(points[1].second - finest);
  if (!(first > 0.0) || !(second > 0.0) || !(points[0].first > points[1].first)) return std::nullopt;
  return std::log(first / second) / std::log(points[0].first / points[1].first);
}

std::string to_markdown(const std::vector<ResultFile>& results, const std::string& plots) {
  std::string out =
      "# Verification of the press\n\n"
      "Made by `make -f Makefile.data verification`; each case is a file of `configs/verification/` "
      "(see [the format](verification_cases.md)).\n\n"
      "| Case | Vertices | Quantity | Measured | Expected | Deviation | Limit | |\n|---|---|---|---|---|---|---|---|\n";
  std::map<std::string, std::vector<const ResultFile*>> studies;
  for (const ResultFile& file : results) {
    if (file.study) studies[file.study->name].push_back(&file);
    if (file.reason) {
      out += fmt::format("| {} | | | | | | | **{}**: {} |\n", file.title, file.state, *file.reason);
      continue;
    }
    bool first = true;
    for (const ResultRow& row : file.rows) {
      if (file.study && row.limit == "at least 0") continue;  // only recorded for the study's table
      const bool percent = row.limit.ends_with("%");
      out += fmt::format("| {} | {} | {} | {:.5g} {} | {} | {} | {} | {} |\n",
                         first ? fmt::format("[{}](../configs/verification/{}.yaml)", file.title, file.name) : "",
                         first ? fmt::format("{}", file.gel_vertices) : "", row.label, row.measured, row.unit,
                         row.expected ? fmt::format("{:.5g} {}", *row.expected, row.unit) : "",
                         percent ? fmt::format("{:+.2f} %", row.deviation) : "", row.limit,
                         row.pass ? "holds" : "**missed**");
      first = false;
    }
    if (file.fitted_modulus_pa)
      out += fmt::format("| | | fitted modulus | {:.4g} Pa | | | | |\n", *file.fitted_modulus_pa);
  }
  out += "\n## Where the numbers come from\n\n";
  for (const ResultFile& file : results) out += fmt::format("- {}: {}\n", file.title, file.source);
  if (!studies.empty()) out += "\n## Refinement\n\n";
  for (const auto& [name, files] : studies) out += study_table(name, files);
  out += "\n## Curves\n\n";
  for (const ResultFile& file : results)
    if (!file.reason) out += fmt::format("![{}]({}/{}.svg)\n", file.title, plots, file.name);
  return out;
}

}  // namespace tacipc::verify
