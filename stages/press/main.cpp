#include <fmt/core.h>
#include <malloc.h>

#include "common/log.h"
#include "common/object.h"
#include "common/placement.h"
#include "common/stage.h"
#include "stages/press/checkpoint.h"
#include "stages/press/outputs.h"

namespace {

const tacipc::StageSpec kPress{
    .name = "press",
    .summary =
        "Press an object into the gel: incremental potential contact, every frame proven free of intersection and "
        "inversion.",
    .inputs = {{.flag = "--config", .help = "numerics (YAML)"},
               {.flag = "--sensor", .help = "sensor (YAML)"},
               {.flag = "--sample", .help = "placement and motion (YAML)"},
               {.flag = "--gel", .help = "tetrahedral gel (gel.msh of tetmesh)"},
               {.flag = "--object", .help = "closed triangle mesh in metres (object.ply of decimate)"},
               {.flag = "--object-config", .help = "the object's YAML: which side is up", .required = false}},
    .options = {{.flag = "--name", .help = "the sample's name", .fallback = "sample"}},
    .resumable = true};

/// Newton's method takes and leaves the same few megabytes again and again: given back to the system each time,
/// up to a tenth of the run would go into getting zeroed pages.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_TOP_PAD, 64 << 20);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace tacipc;
  keep_freed_memory();
  return run_stage(kPress, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<PressConfig>("--config");
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const auto sample = stage.read_config<SampleSpec>("--sample");
    std::string face = "-z";
    if (stage.optional_input("--object-config")) {
      if (const auto up = stage.read_config<ObjectSpec>("--object-config").up) face = opposite_face(*up);
    }
    for (const Phase& phase : sample.motion) {
      if (phase.kind == PhaseKind::path) stage.add_input("path", phase.file);
    }
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    const TriangleMesh object = read_triangle_mesh(stage.input("--object"), 1.0);
    ScratchFrames frames(stage);
    const Simulation simulation = simulate(
        sensor, gel, object, config, sample, face,
        [](int frame, int count, int iteration, double residual) {
          show_progress((frame - 1.0) / count, fmt::format("frame {}/{}, Newton iteration {}, residual {:.1e} m/s",
                                                           frame, count, iteration, residual));
        },
        &frames);
    write_outputs(stage, sensor, gel, config, sample, simulation);
  });
}
