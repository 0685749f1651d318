// Refines one parameter of a scene and measures how the results converge.
#include <fmt/format.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "verification/refinement.h"
#include "verification/shared_files.h"

using namespace tacipc;

namespace {

const StageSpec kRefinement{.name = "refinement",
                            .summary = "Refine one number of a scene and measure how the results converge.",
                            .inputs = {{"--scene", "scene and what of it is refined (YAML)"}},
                            .options = {{"--study", "which number: mesh, time_step, d_hat, speed_threshold", "mesh"}},
                            .resumable = true};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kRefinement, argc, argv, [](Stage& stage) {
    const auto spec = stage.read_config<verify::RefinementSpec>("--scene");
    const verify::RefinementStudy& study = spec.study(stage.option("--study"));
    std::vector<verify::CaseSpec> scenes;
    for (int k = 0; k < study.levels; ++k)
      scenes.push_back(verify::refined(spec.scene, study.parameter, study.scale(k)));
    verify::RefinementResult result = verify::describe(spec, study, scenes);
    std::vector<verify::RefinementLevel> levels;
    for (int k = 0; k < study.levels; ++k) {
      const std::string name = fmt::format("level_{}", k);
      const auto saved = stage.load_scratch(name);
      auto level = saved ? verify::RefinementLevel::unpack(*saved) : std::nullopt;
      if (!level) {
        level = verify::run_level(spec, scenes[k], verify::shared_folder());
        stage.save_scratch(name, level->pack());
      }
      levels.push_back(std::move(*level));
      result.gel_vertices.push_back(levels.back().gel_vertices);
      log_info("{} {:g} {}: {} vertices, press {:.5g} N, tangential {:.5g} N", result.parameter,
               result.parameter_values[k], result.unit, levels.back().gel_vertices, levels.back().press_force_n,
               levels.back().tangential_force_n);
    }
    result.curves = verify::compare_levels(levels, study.factor);
    const Value value = verify::to_value(result);
    write_file(stage.output("result.yaml"), to_yaml(value));
    stage.summarize(value.map());
  });
}
