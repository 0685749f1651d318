#include <fmt/core.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sample/sample_inputs.h"
#include "common/stage/stage.h"
#include "stages/gel/press/drive/grasp.h"
#include "stages/gel/press/drive/scene.h"
#include "stages/gel/press/drive/simulate.h"
#include "stages/gel/press/files/outputs.h"
#include "stages/gel/press/files/scene_files.h"

namespace {

const tacipc::StageSpec kPress{
    .name = "press",
    .summary =
        "Press an object into the gel: incremental potential contact, every frame proven free of intersection and "
        "inversion.",
    .inputs =
        {{.flag = "--config", .help = "numerics (YAML)"},
         {.flag = "--sensor", .help = "sensor (YAML)"},
         {.flag = "--sample", .help = "placement and motion, a grasp by two fingers, or a scene of bodies (YAML)"},
         {.flag = "--gel", .help = "tetrahedral gel (gel.msh of tetmesh)"},
         {.flag = "--object",
          .help = "closed triangle mesh in metres (object.ply of decimate); none for a scene, which names its own",
          .required = false},
         {.flag = "--object-config", .help = "the object's YAML: which side is up", .required = false},
         {.flag = "--soft",
          .help = "of a scene: folder with <name>/object.msh of tetmesh for each soft body whose mesh is a surface",
          .required = false},
         {.flag = "--solved",
          .help = "of a scene: folder of frames that a press of its beginning has left in solved/, to go on from",
          .required = false}},
    .options = {{.flag = "--name", .help = "the sample's name", .fallback = "sample"}},
    .resumable = true};

/// Keeps freed memory in the process. Newton's method allocates and frees the same few megabytes in every iteration;
/// returning them to the system each time would spend up to a tenth of the run on zeroed pages.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_TOP_PAD, 64 << 20);
}

/// Restarts the program with huge pages. The solver sweeps over tens of megabytes repeatedly, and huge pages save a
/// tenth of the time. glibc uses them only if an environment variable is set at the start of a program.
void ask_for_huge_pages(char** argv) {
  constexpr const char* kVariable = "GLIBC_TUNABLES";
  if (std::getenv(kVariable) != nullptr) return;
  setenv(kVariable, "glibc.malloc.hugetlb=1", 1);
  std::error_code unreadable;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unreadable);
  if (!unreadable) execv(program.c_str(), argv);  // on failure the program continues
}

}  // namespace

int main(int argc, char** argv) {
  using namespace tacipc;
  ask_for_huge_pages(argv);
  keep_freed_memory();
  return run_stage(kPress, argc, argv, [](Stage& stage) {
    const auto file = stage.read_config<PressConfig>("--config");
    const auto sensor = stage.read_config<Sensor>("--sensor");
    const PressConfig config = file.with_friction_of(sensor);
    const auto tell_friction = [&] {
      if (!file.takes_friction_of(sensor)) return;
      log_info("friction {:g} of the sensor's gel, instead of {:g} of the press file", *sensor.friction,
               file.coefficient_of_friction());
      stage.note("friction_from", "sensor");
    };
    const auto progress = [](int frame, int count, int iteration, double residual) {
      show_progress((frame - 1.0) / count, fmt::format("frame {}/{}, Newton iteration {}, residual {:.1e} m/s", frame,
                                                       count, iteration, residual));
    };
    const ConfigReader what = ConfigReader::from_file(stage.input("--sample"));
    if (what.has("bodies")) {
      tell_friction();
      const SceneFiles scene = read_scene(stage, sensor);
      write_outputs(stage, sensor, scene.bodies, scene.spec,
                    run_scene(sensor, scene.bodies, file, scene.spec, progress, scene.frames.get()));
      return;
    }
    if (!stage.optional_input("--object"))
      throw UsageError("--object is missing: what is pressed or gripped (only a scene names its bodies itself)");
    if (stage.optional_input("--soft")) throw UsageError("--soft: only a scene has soft bodies");
    if (stage.optional_input("--solved")) throw UsageError("--solved: only a scene is solved piece by piece");
    if (what.has("fingers")) {
      if (stage.optional_input("--object-config"))
        throw UsageError("--object-config says which side of the object is up; fingers take it as it is");
      const auto spec = stage.read_config<GraspSpec>("--sample");
      if (!spec.friction_coefficient) tell_friction();
      const TriangleMesh object = read_triangle_mesh(stage.input("--object"), 1.0);
      const TetMesh gel = read_tet_mesh(stage.input("--gel"));
      ScratchFrames frames(stage);
      write_outputs(stage, sensor, gel, grasp(sensor, gel, object, config, spec, progress, &frames));
      return;
    }
    tell_friction();
    const SampleInputs inputs = read_sample(stage);
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    ScratchFrames frames(stage);
    const Simulation simulation =
        simulate(sensor, gel, inputs.object, config, inputs.sample, inputs.face, progress, &frames);
    write_outputs(stage, sensor, gel, inputs.sample, simulation);
  });
}
