// Compares presses with the default settings with presses in which one setting differs.
#include "bench/defaults_report.h"
#include "bench/machine.h"
#include "common/base/files.h"
#include "common/stage/stage.h"

using namespace tacipc;

namespace {

const StageSpec kTable{
    .name = "defaults_table",
    .summary = "Put presses with the shipped settings, and with one of them changed, side by side.",
    .inputs = {InputSpec::several("--press",
                                  "folder of a press, named gel-object-motion-route: press-default, -once, "
                                  "-frictionless, -wide, -near; shear-default")}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTable, argc, argv, [](Stage& stage) {
    const std::vector<bench::DefaultsRow> rows = bench::read_defaults(stage.inputs("--press"));
    write_file(stage.output("table.md"), bench::defaults_table(rows, bench::processor()));
    stage.summarize({{"objects", rows.size()}});
  });
}
