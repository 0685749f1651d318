// Compares the same samples by two routes. `holds` in the record states whether all of them agree.
#include "bench/routes_report.h"
#include "common/base/files.h"
#include "common/stage/stage.h"

using namespace tacipc;

namespace {

const StageSpec kTable{
    .name = "routes_table",
    .summary = "Put samples that were pressed by two routes side by side.",
    .inputs = {
        {"--limits", "largest differences between agreeing results (YAML)"},
        InputSpec::several("--press", "folder of a press, named gel-object-pose-fast or gel-object-pose-direct")}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTable, argc, argv, [](Stage& stage) {
    const auto limits = stage.read_config<bench::RouteLimits>("--limits");
    const std::vector<bench::RoutePair> pairs = bench::read_route_pairs(stage.inputs("--press"));
    write_file(stage.output("routes.md"), bench::routes_page(pairs, limits));
    const bench::RouteSummary sum = bench::summarize(pairs, limits);
    stage.summarize({{"samples", sum.samples},
                     {"fast_converged", sum.fast_converged},
                     {"direct_converged", sum.direct_converged},
                     {"agree", sum.agree},
                     {"median_rms_m", sum.median_rms_m},
                     {"fast_s", sum.fast_s},
                     {"direct_s", sum.direct_s},
                     {"holds", sum.holds()}});
  });
}
