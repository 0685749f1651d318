#include "verification/table_report.h"

#include <fmt/format.h>

#include "common/config/config.h"
#include "tacipc_verification_texts.h"

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

}  // namespace tacipc::verify
