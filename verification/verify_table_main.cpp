// Combines the results of verification cases and of campaigns into the page and its plots. The record counts missed
// rows.
#include <fmt/format.h>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "verification/shared_files.h"
#include "verification/table_report.h"

using namespace tacipc;

namespace {

const StageSpec kTable{.name = "verify_table",
                       .summary = "Put the results of verification cases together as one page.",
                       .inputs = {InputSpec::several("--result", "folder of a case's result"),
                                  InputSpec::optional("--rows", "long rows that the page shows (YAML)"),
                                  InputSpec::any_number("--long", "record of a long row, or its failure file")}};

std::vector<verify::LongRowResult> read_long_rows(Stage& stage) {
  std::vector<verify::LongRowResult> results;
  if (!stage.optional_input("--rows")) return results;
  int skipped = 0, missed = 0;
  for (const verify::LongRow& row : stage.read_config<verify::LongRows>("--rows").rows) {
    results.push_back(verify::read_long_row(row, stage.inputs("--long"), verify::shared_folder()));
    const verify::LongRowResult& result = results.back();
    log_info("{}: {}: {}", row.title, result.state == "pass" ? "holds" : result.state, result.found);
    skipped += result.state == "skipped";
    missed += result.state != "skipped" && result.state != "pass";
  }
  stage.summarize({{"long_rows", results.size()}, {"long_skipped", skipped}, {"long_missed", missed}});
  return results;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTable, argc, argv, [](Stage& stage) {
    std::vector<verify::ResultFile> results;
    std::vector<std::string> unfinished;  // folders of cases that did not pass
    int missed = 0, skipped = 0;
    for (const auto& folder : stage.inputs("--result")) {
      results.push_back(verify::read_result(folder / "result.yaml"));
      const verify::ResultFile& result = results.back();
      write_file(stage.output("verification/" + result.name + ".svg"), read_file(folder / "plot.svg"));
      for (const verify::Row& row : result.rows) {
        log_info("{}: {}: {:.5g} {}{} ({}): {}", result.name, row.label, row.measured, row.unit,
                 row.expected ? fmt::format(", expected {:.5g}", *row.expected) : "", row.limit,
                 row.pass ? "holds" : "MISSED");
      }
      if (result.reason) log_info("{}: {}: {}", result.name, result.state, *result.reason);
      if (result.state != "pass") unfinished.push_back(folder.string());
      skipped += result.state == "skipped";
      missed += result.state == "missed" || result.state == "failed";
    }
    stage.summarize({{"cases", results.size()}, {"skipped", skipped}, {"missed", missed}});
    const std::vector<verify::LongRowResult> long_rows = read_long_rows(stage);
    write_file(stage.output("verification.md"), verify::to_markdown(results, long_rows, "verification"));
    log_info("{} cases, {} skipped, {} miss a limit", results.size(), skipped, missed);
    std::string list;
    for (const auto& folder : unfinished) list += folder + "\n";
    write_file(stage.output("unfinished.txt"), list);
  });
}
