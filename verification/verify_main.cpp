// Runs one verification case: compares measured with expected values.
#include <fmt/format.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "verification/run_case.h"
#include "verification/shared_files.h"

using namespace tacipc;

namespace {

const StageSpec kVerify{.name = "verify",
                        .summary = "Run one verification case and compare it with what is expected.",
                        .inputs = {{"--case", "case (YAML): gel, object, motion, expected numbers"}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kVerify, argc, argv, [](Stage& stage) {
    const auto spec = stage.read_config<verify::CaseSpec>("--case");
    const verify::CaseResult result = verify::run_case(spec, verify::shared_folder(), [](int, int, int, double) {});
    const Value value = verify::to_value(result);
    write_file(stage.output("result.yaml"), to_yaml(value));
    write_file(stage.output("curves.csv"), verify::to_csv(result));
    write_file(stage.output("plot.svg"), verify::to_svg(result));
    for (const verify::Row& row : result.judgement.rows) {
      log_info("{}: {:.6g} {}{}, {}: {}", row.label, row.measured, row.unit,
               row.expected ? fmt::format(", expected {:.6g}", *row.expected) : "", row.limit,
               row.pass ? "holds" : "MISSED");
    }
    stage.summarize(value.map());
  });
}
