#include "common/files.h"
#include "common/stage.h"
#include "stages/cost_table/costs.h"

namespace {

using namespace tacipc;

const StageSpec kCostTable{
    .name = "cost_table",
    .summary = "One table of what stages cost over many runs: processor seconds and peak memory.",
    .inputs = {{.flag = "--config", .help = "rows: which stage, in which folders (YAML)"},
               {.flag = "--timings", .help = "<stage>.timings.yaml of all runs that count", .many = true}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kCostTable, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<CostTableConfig>("--config");
    const std::vector<Cost> costs = costs_of(stage.inputs("--timings"), config);
    // No two runs agree in times.
    write_file(stage.varying_output("table.md"), to_markdown(costs, config));
    write_file(stage.varying_output("table.csv"), to_csv(costs));
    stage.summarize({{"rows", costs.size()}});
  });
}
