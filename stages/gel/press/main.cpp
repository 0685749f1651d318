#include <fmt/core.h>
#include <malloc.h>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/sample/sample_inputs.h"
#include "common/stage/stage.h"
#include "stages/gel/press/checkpoint.h"
#include "stages/gel/press/outputs.h"

namespace {

const tacipc::StageSpec kPress{
    .name = "press",
    .summary =
        "Press an object into the gel: incremental potential contact, every frame proven free of intersection and "
        "inversion.",
    .inputs = {{.flag = "--config", .help = "numerics (YAML)"},
               {.flag = "--sensor", .help = "sensor (YAML)"},
               {.flag = "--sample", .help = "placement and motion, or a grasp by two fingers (YAML)"},
               {.flag = "--gel", .help = "tetrahedral gel (gel.msh of tetmesh)"},
               {.flag = "--object", .help = "closed triangle mesh in metres (object.ply of decimate)"},
               {.flag = "--object-config", .help = "the object's YAML: which side is up", .required = false}},
    .options = {{.flag = "--name", .help = "the sample's name", .fallback = "sample"}},
    .resumable = true};

/// Frames of a grasp as scratch files of the stage.
class ScratchBytes final : public tacipc::ByteStore {
 public:
  explicit ScratchBytes(tacipc::Stage& stage) : stage_(stage) {}
  void save(const std::string& bytes) override { stage_.save_scratch(name(), bytes), ++next_; }
  std::optional<std::string> load() override {
    auto bytes = stage_.load_scratch(name());
    if (bytes) ++next_;
    return bytes;
  }

 private:
  std::string name() const { return fmt::format("grasp_{:05d}", next_); }
  tacipc::Stage& stage_;
  int next_ = 0;
};

/// Newton's method allocates and frees the same few megabytes in every iteration. Given back to the system each time,
/// up to a tenth of the run would be spent on zeroed pages.
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
    const auto progress = [](int frame, int count, int iteration, double residual) {
      show_progress((frame - 1.0) / count, fmt::format("frame {}/{}, Newton iteration {}, residual {:.1e} m/s", frame,
                                                       count, iteration, residual));
    };
    if (ConfigReader::from_file(stage.input("--sample")).has("fingers")) {
      if (stage.optional_input("--object-config"))
        throw UsageError("--object-config says which side of the object is up; fingers take it as it is");
      const auto spec = stage.read_config<GraspSpec>("--sample");
      const TriangleMesh object = read_triangle_mesh(stage.input("--object"), 1.0);
      const TetMesh gel = read_tet_mesh(stage.input("--gel"));
      ScratchBytes frames(stage);
      write_outputs(stage, sensor, gel, config, grasp(sensor, gel, object, config, spec, progress, &frames));
      return;
    }
    const SampleInputs inputs = read_sample(stage);
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    ScratchFrames frames(stage);
    const Simulation simulation =
        simulate(sensor, gel, inputs.object, config, inputs.sample, inputs.face, progress, &frames);
    write_outputs(stage, sensor, gel, config, inputs.sample, simulation);
  });
}
