// Puts the presses of the benchmark together: tables, a plot, the cost model.
#include "bench/bench_report.h"
#include "bench/element_study.h"
#include "bench/machine.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/stage/stage.h"

using namespace tacipc;

namespace {

const StageSpec kTable{.name = "bench_table",
                       .summary = "Put presses of the benchmark together as tables, a plot and the cost model.",
                       .inputs = {{"--press", "folder of a press, named gel-object-motion-route[-how]", true, true}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTable, argc, argv, [](Stage& stage) {
    std::vector<bench::Run> runs, usual;
    for (const auto& folder : stage.inputs("--press")) {
      runs.push_back(bench::read_run(folder));
      const auto& name = runs.back().name;
      if ((name.motion == "press" || name.motion == "shear") && (name.route == "fast" || name.route == "averaged") &&
          name.how.empty())
        usual.push_back(runs.back());
    }
    if (usual.size() < 5) throw DataError("{} presses by the default route: the cost model needs five", usual.size());
    const bench::CostModel model = bench::fit_cost_model(usual);
    write_file(stage.output("performance.md"), bench::bench_page(runs, model, bench::processor()));
    write_file(stage.output("bench_press.svg"), bench::bench_svg(runs));
    write_file(stage.output("bench_elements.svg"), bench::element_svg(runs));
    write_file(stage.output("cost_model.yaml"), bench::to_yaml_text(model));
    stage.summarize({{"presses", runs.size()}, {"largest_ratio", model.largest_ratio}});
  });
}
