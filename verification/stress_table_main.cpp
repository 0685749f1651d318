// Combines the cases of a stress campaign. `holds` in the record is the campaign's verdict.
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "verification/stress_summary.h"

using namespace tacipc;

namespace {

const StageSpec kStressTable{.name = "stress_table",
                             .summary = "Put the cases of a stress campaign together as one page.",
                             .inputs = {InputSpec::several("--case", "folder of a case")},
                             .options = {{"--seed", "seed of the campaign", "1"},
                                         {"--ranges", "file of configs/studies/stress", verify::kStressRanges}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kStressTable, argc, argv, [](Stage& stage) {
    std::vector<verify::StressLine> lines;
    for (const auto& folder : stage.inputs("--case")) lines.push_back(verify::read_stress_line(folder));
    write_file(stage.output("summary.md"),
               verify::to_markdown(lines, stage.option("--seed"), stage.option("--ranges")));
    const verify::StressSummary sum = verify::summarize(lines);
    const std::string found = verify::found(sum, stage.option("--seed"));
    log_info("{}: {}", found, sum.holds() ? "holds" : "DOES NOT HOLD");
    stage.summarize({{"cases", sum.cases},
                     {"converged", sum.converged},
                     {"not_converged", sum.not_converged},
                     {"intersected", sum.intersected},
                     {"inverted", sum.inverted},
                     {"crashed", sum.crashed},
                     {"holds", sum.holds()},
                     {"found", found}});
  });
}
