#include <fmt/core.h>

#include <optional>

#include "common/error.h"
#include "common/files.h"
#include "common/picture.h"
#include "common/stage.h"
#include "stages/render/render.h"

namespace {

using namespace tacipc;

const StageSpec kRender{
    .name = "render",
    .summary = "Make tactile images of a pressed gel: light, shadows, depth, normals, noise.",
    .inputs = {{.flag = "--config", .help = "render settings (YAML)"},
               {.flag = "--sensor", .help = "the sensor: lights, camera, coating (YAML)"},
               {.flag = "--gel", .help = "gel.msh of tetmesh"},
               {.flag = "--press", .help = "folder that press wrote: positions.npy and press.yaml"}}};

void write_frame(Stage& stage, const RenderedFrame& frame) {
  const std::string folder = fmt::format("frame_{:04}/", frame.index);
  write_exr(stage.output(folder + "linear.exr"), frame.linear, {"R", "G", "B"});
  write_exr(stage.output(folder + "depth.exr"), frame.trace.depth, {"Z"});
  write_exr(stage.output(folder + "normal.exr"), frame.trace.normal, {"X", "Y", "Z"});
  write_exr(stage.output(folder + "indentation.exr"), frame.trace.indentation, {"Y"});
  write_png(stage.output(folder + "tactile.png"), frame.tactile.image);
  write_png(stage.output(folder + "normal.png"), picture_of_normals(frame.trace.normal));
  write_png(stage.output(folder + "indentation.png"), indentation_picture(frame.trace.indentation));
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kRender, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<RenderConfig>("--config");
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const auto press = stage.input("--press");
    if (!std::filesystem::exists(press / "press.yaml")) {
      throw DataError("{}: has no press.yaml, so the press did not finish", press.string());
    }
    std::optional<ByteImage> reference;
    if (sensor.reference_image) {
      reference = read_reference(*sensor.reference_image, sensor.camera);
      stage.note("reference", content_hash(*sensor.reference_image));
    } else {
      stage.note("reference", "synthetic");
    }
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    const NpyArray positions = read_npy(press / "positions.npy");
    check_positions(positions, gel, (press / "positions.npy").string());

    const RenderSummary summary = render(sensor, config, gel, positions, reference,
                                         [&](const RenderedFrame& frame) { write_frame(stage, frame); });
    stage.summarize({{"frames", Value::List(summary.frames.begin(), summary.frames.end())},
                     {"exposure", summary.exposure},
                     {"reference_mean_code", summary.reference_mean_code},
                     {"clipped_fraction", summary.clipped_fraction},
                     {"rays", summary.rays},
                     {"nudged_rays", summary.nudged_rays},
                     {"outside_rays", summary.outside_rays},
                     {"max_indentation_mm", 1e3 * summary.max_indentation_m}});
  });
}
