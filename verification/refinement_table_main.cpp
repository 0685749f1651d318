// Combines refinement studies into tables and plots.
#include <fmt/format.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "verification/refinement.h"

using namespace tacipc;

namespace {

const StageSpec kTable{.name = "refinement_table",
                       .summary = "Put studies of refinement together as tables and plots.",
                       .inputs = {InputSpec::several("--result", "folder of a study's result")}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTable, argc, argv, [](Stage& stage) {
    std::vector<verify::RefinementResult> results;
    int failed = 0, unsettled = 0;
    for (const auto& folder : stage.inputs("--result")) {
      results.push_back(verify::read_refinement(folder));
      const verify::RefinementResult& result = results.back();
      if (result.failed) {
        log_info("{}: failed: {}", result.study, *result.failed);
        ++failed;
        continue;
      }
      write_file(stage.output(fmt::format("refinement_{}.svg", result.study)), verify::refinement_svg(result));
      for (const std::string& quantity : verify::not_converging(result)) {
        log_info("{}: refinement does not converge: {}", result.study, quantity);
        ++unsettled;
      }
    }
    write_file(stage.output("tables.md"), verify::refinement_tables(results, "."));
    stage.summarize({{"studies", results.size()},
                     {"failed", failed},
                     {"unsettled", unsettled},
                     {"holds", verify::holds(results)},
                     {"found", verify::found(results)}});
  });
}
