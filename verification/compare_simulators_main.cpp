// Compares the markers of several simulators under the same moving object; writes a fragment of a page and its
// pictures.
#include <fmt/core.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/stage/stage.h"
#include "verification/simulator_comparison.h"

using namespace tacipc;

namespace {

const StageSpec kCompareSimulators{
    .name = "compare_simulators",
    .summary = "Compare the markers of several simulators under a dragged or turned object.",
    .inputs = {{"--config", "which markers, motions and simulators (YAML)"},
               InputSpec::several("--run", "folders of press or mpm: for each simulator in order each motion in order"),
               InputSpec::any_number("--factor", "folder of a run of the first motion with a changed value")}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kCompareSimulators, argc, argv, [](Stage& stage) {
    verify::ComparedRuns all{
        .config = stage.read_config<verify::SimulatorComparison>("--config"), .runs = {}, .factors = {}};
    const auto& folders = stage.inputs("--run");
    const std::size_t motions = all.config.motions.size(), wanted = all.config.simulators.size() * motions;
    if (folders.size() != wanted)
      throw UsageError(fmt::format("--run: {} folders are given, {} simulators with {} motions each need {}",
                                   folders.size(), all.config.simulators.size(), motions, wanted));
    for (const auto& folder : folders) all.runs.push_back(verify::SimulatorRun::read(folder));
    for (const auto& folder : stage.inputs("--factor")) all.factors.push_back(verify::SimulatorRun::read(folder));

    const std::string& title = all.config.title;
    const std::string pictures = "paper_results";
    Value::List found;
    for (std::size_t m = 0; m < motions; ++m) {
      const std::string name = title + "_" + all.config.motions[m];
      write_file(stage.output(pictures + "/" + name + "_curves.svg"), verify::comparison_curve_svg(all, m));
      write_file(stage.output(name + "_curves.csv"), verify::comparison_curve_csv(all, m));
      double longest_m = 0.0;
      for (std::size_t s = 0; s < all.config.simulators.size(); ++s)
        if (const auto& motion = all.at(s, m).motion)
          longest_m = std::max(longest_m, verify::longest_displacement(*motion));
      for (std::size_t s = 0; s < all.config.simulators.size(); ++s) {
        auto& motion = all.runs[s * motions + m].motion;
        if (!motion) continue;
        const std::string& simulator = all.config.simulators[s].name;
        motion->name = all.config.simulators[s].label;
        write_file(stage.output(pictures + "/" + name + "_" + simulator + ".svg"),
                   verify::marker_quiver_svg(*motion, all.config.chosen, longest_m));
        write_file(stage.output(name + "_" + simulator + "_vectors.csv"), verify::marker_vectors_csv(*motion));
        found.emplace_back(
            Value::Map{{"motion", all.config.motions[m]},
                       {"simulator", simulator},
                       {"mean_displacement_m", verify::mean_displacements(*motion, all.config.chosen).back()}});
      }
    }
    write_file(stage.output(title + ".md"), verify::comparison_page(all, pictures));
    stage.summarize({{"found", std::move(found)}});
  });
}
