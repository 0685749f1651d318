#include "verification/table_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/config/config.h"
#include "tacipc_verification_texts.h"
#include "verification/shared_files.h"
#include "verification/stage_record.h"

namespace tacipc::verify {

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
  if (in.has("rows")) {
    for (ConfigReader& row : in.sections("rows")) {
      file.rows.push_back({.label = row.text("label"),
                           .unit = row.text("unit"),
                           .measured = row.number("measured"),
                           .expected = row.optional_number("expected"),
                           .limit = row.text("limit"),
                           .deviation = row.number("deviation"),
                           .pass = row.flag("pass")});
    }
  }
  in.finish();
  return file;
}

std::string to_markdown(const std::vector<ResultFile>& results, const std::vector<LongRowResult>& long_rows,
                        const std::string& plots) {
  std::string rows, sources, curves;
  for (const ResultFile& file : results) {
    if (file.reason) {
      rows += fmt::format("| {} | | | | | | | **{}**: {} |\n", file.title, file.state, *file.reason);
      continue;
    }
    bool first = true;
    for (const Row& row : file.rows) {
      const bool percent = row.limit.ends_with("%");
      rows += fmt::format(
          "| {} | {} | {} | {:.5g} {} | {} | {} | {} | {} |\n",
          first ? fmt::format("[{}](../configs/studies/verification/{}.yaml)", file.title, file.name) : "",
          first ? fmt::format("{}", file.gel_vertices) : "", row.label, row.measured, row.unit,
          row.expected ? fmt::format("{:.5g} {}", *row.expected, row.unit) : "",
          percent ? fmt::format("{:+.2f} %", row.deviation) : "", row.limit, row.pass ? "holds" : "**missed**");
      first = false;
    }
    if (file.fitted_modulus_pa)
      rows += fmt::format("| | | fitted modulus | {:.4g} Pa | | | | |\n", *file.fitted_modulus_pa);
  }
  for (const ResultFile& file : results) {
    sources += fmt::format("- {}: {}\n", file.title, file.source);
    if (!file.reason) curves += fmt::format("![{}]({}/{}.svg)\n", file.title, plots, file.name);
  }
  return fmt::format(kVerificationPage, rows, long_rows_section(long_rows), sources, curves);
}

LongRow LongRow::read(ConfigReader& in) {
  return {.title = in.text("title"),
          .shows = in.text("shows"),
          .goal = in.text("goal"),
          .stage = in.text("stage"),
          .page = in.text("page"),
          .needs = in.optional_text("needs")};
}

LongRows LongRows::read(ConfigReader& in) {
  LongRows out;
  for (ConfigReader& row : in.sections("rows")) out.rows.push_back(LongRow::read(row));
  return out;
}

LongRowResult read_long_row(const LongRow& row, const std::vector<std::filesystem::path>& files,
                            const std::filesystem::path& shared) {
  const auto file = std::ranges::find_if(files, [&](const std::filesystem::path& f) {
    return f.filename() == row.stage + ".yaml" || f.filename() == row.stage + ".failed.yaml";
  });
  if (file == files.end()) {
    if (const auto why = row.needs ? why_skipped(*row.needs, shared) : std::nullopt) return {row, "skipped", *why};
    return {row, "not run", fmt::format("`make -f Makefile.data {}`", row.goal)};
  }
  if (const auto why = why_no_record(file->parent_path(), row.stage)) return {row, "failed", *why};
  ConfigReader in = ConfigReader::from_file(*file);
  for (const std::string& key : in.keys())
    if (key != "summary") in.ignore(key);
  ConfigReader summary = in.section("summary");
  for (const std::string& key : summary.keys())
    if (key != "holds" && key != "found") summary.ignore(key);
  LongRowResult result{row, summary.flag("holds") ? "pass" : "missed", summary.text("found")};
  in.finish();
  return result;
}

std::string long_rows_section(const std::vector<LongRowResult>& rows) {
  if (rows.empty()) return "";
  std::string out = "## Long rows\n\n| Row | Shows | Found | |\n|---|---|---|---|\n";
  for (const LongRowResult& r : rows) {
    if (r.state == "pass" || r.state == "missed")
      out += fmt::format("| [{}]({}) | {} | {} | {} |\n", r.row.title, r.row.page, r.row.shows, r.found,
                         r.state == "pass" ? "holds" : "**missed**");
    else
      out += fmt::format("| {} | {} | | **{}**: {} |\n", r.row.title, r.row.shows, r.state, r.found);
  }
  return out + "\n";
}

}  // namespace tacipc::verify
