#include "verification/long_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "verification/shared_files.h"
#include "verification/stage_record.h"

namespace tacipc::verify {

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
