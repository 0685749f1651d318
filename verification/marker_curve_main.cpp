// Measures the smoothness of marker motion under an object that moves sideways or turns: tables, curves, arrows.

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "verification/marker_curve.h"

using namespace tacipc;

namespace {

const StageSpec kMarkerCurve{
    .name = "marker_curve",
    .summary = "Judge the evenness of the markers' motion under a dragged or turned object.",
    .inputs = {{"--config", "which markers, and what counts as settled and as even (YAML)"},
               InputSpec::several("--press", "folder of a press whose object is dragged or turned"),
               InputSpec::any_number("--other", "folder of the same motion by another simulator, drawn beside it")}};

/// Writes the plot of all markers in the last frame, and their vectors in every frame.
void write_motion(Stage& stage, const std::string& name, const verify::MarkerMotion& motion,
                  const verify::MarkerCurveConfig& config) {
  write_file(stage.output(name + "_quiver.svg"), verify::marker_quiver_svg(motion, config.chosen));
  write_file(stage.output(name + "_vectors.csv"), verify::marker_vectors_csv(motion));
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kMarkerCurve, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<verify::MarkerCurveConfig>("--config");
    std::vector<verify::MarkerMotion> others;
    for (const auto& folder : stage.inputs("--other")) others.push_back(verify::read_other_motion(folder));
    std::vector<verify::SlidingRun> runs;
    std::vector<verify::MarkerCurve> curves;
    Value::List samples;
    int missed = 0;
    for (const auto& folder : stage.inputs("--press")) {
      runs.push_back(verify::read_sliding_run(folder));
      const verify::SlidingRun& run = runs.back();
      curves.push_back(verify::marker_curve(run, config));
      const verify::MarkerCurve& curve = curves.back();
      const bool holds = curve.ratio() < config.second_difference_limit;
      missed += !holds;
      log_info("{}: second differences {:.2f} % of the largest first difference once settled (limit {:g} %): {}",
               run.name, 100.0 * curve.ratio(), 100.0 * config.second_difference_limit, holds ? "holds" : "MISSED");
      samples.emplace_back(Value::Map{{"name", run.name},
                                      {"gel_vertices", run.gel_vertices},
                                      {"largest_first_difference_m", curve.largest_first_m},
                                      {"settled_frame", run.press_end_frame + curve.settled},
                                      {"largest_second_difference_m", curve.largest_second_m},
                                      {"largest_second_difference_ever_m", curve.largest_second_ever_m},
                                      {"ratio", curve.ratio()},
                                      {"holds", holds}});
      write_file(stage.output(run.name + ".csv"), verify::marker_curve_csv(run, curve));
      write_file(stage.output(run.name + "_curve.svg"), verify::marker_curve_svg(run, curve, others, config));
      write_file(stage.output(run.name + "_differences.svg"), verify::marker_difference_svg(run, curve));
      write_motion(stage, run.name, run, config);
      for (const verify::MarkerMotion& other : others)
        if (other.turns == run.turns) write_motion(stage, run.name + "_" + other.name, other, config);
    }
    write_file(stage.output("tables.md"), verify::marker_curve_page(runs, curves, others, config));
    stage.summarize({{"missed", missed},
                     {"holds", missed == 0},
                     {"found", verify::marker_curve_found(runs, curves, config)},
                     {"samples", std::move(samples)}});
  });
}
