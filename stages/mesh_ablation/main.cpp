#include "common/files.h"
#include "common/stage.h"
#include "stages/mesh_ablation/ablation.h"

namespace {

using namespace tacipc;

const StageSpec kMeshAblation{
    .name = "mesh_ablation",
    .summary = "Gel meshes beside each other: vertices, times, memory, depth error against a finer one.",
    .inputs = {{.flag = "--config", .help = "which meshes, in families (YAML)"},
               {.flag = "--gel", .help = "tetmesh.yaml of each mesh", .many = true},
               {.flag = "--press", .help = "press.yaml of all presses", .many = true},
               {.flag = "--render", .help = "render.yaml of all presses", .many = true},
               {.flag = "--depth", .help = "depth_metrics.yaml of each mesh", .many = true}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kMeshAblation, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<MeshAblationConfig>("--config");
    const auto families = read_costs({.gels = stage.inputs("--gel"),
                                      .presses = stage.inputs("--press"),
                                      .renders = stage.inputs("--render"),
                                      .depths = stage.inputs("--depth")},
                                     config);
    // No two runs agree in times.
    write_file(stage.varying_output("table.md"), to_markdown(families, config));
    write_file(stage.varying_output("table.csv"), to_csv(families));
    const std::string folder = config.link_folder.empty() ? "" : config.link_folder + "/";
    write_file(stage.output(folder + "mesh_error.svg"), error_svg(families, config));
    stage.summarize({{"families", families.size()}});
  });
}
