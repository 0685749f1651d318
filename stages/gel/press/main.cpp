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
               {.flag = "--sample",
                .help = "placement and motion, a grasp by two fingers, or a scene of bodies (YAML)"},
               {.flag = "--gel", .help = "tetrahedral gel (gel.msh of tetmesh)"},
               {.flag = "--object",
                .help =
                    "closed triangle mesh in metres (object.ply of decimate); none for a scene, which names its own",
                .required = false},
               {.flag = "--object-config", .help = "the object's YAML: which side is up", .required = false}},
    .options = {{.flag = "--name", .help = "the sample's name", .fallback = "sample"}},
    .resumable = true};

/// Frames of a grasp or a scene as scratch files of the stage.
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
  std::string name() const { return fmt::format("bodies_{:05d}", next_); }
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

void press_scene(tacipc::Stage& stage, const tacipc::Sensor& sensor, const tacipc::PressConfig& config,
                 const tacipc::ProgressObserver& progress) {
  using namespace tacipc;
  if (stage.optional_input("--object") || stage.optional_input("--object-config"))
    throw UsageError("--object and --object-config: the bodies of a scene are named in its file");
  const auto spec = stage.read_config<SceneSpec>("--sample");
  const TetMesh gel = read_tet_mesh(stage.input("--gel"));
  std::vector<SceneBody> bodies;
  for (const BodySpec& spec_of : spec.bodies) {
    SceneBody& body = bodies.emplace_back();
    if (spec_of.kind == BodyKind::gel) {
      body.tets = gel;
      body.material = sensor.material;
      continue;
    }
    stage.add_input("bodies." + spec_of.name + ".mesh", spec_of.mesh);
    if (spec_of.kind == BodyKind::soft) {
      stage.add_input("bodies." + spec_of.name + ".material", spec_of.material);
      body.tets = read_object_tet_mesh(spec_of.mesh);
      body.material = read_config<Material>(spec_of.material);
    } else {
      body.surface = read_triangle_mesh(spec_of.mesh, 1.0);
    }
  }
  ScratchBytes frames(stage);
  write_outputs(stage, sensor, bodies, config, spec, run_scene(sensor, bodies, config, spec, progress, &frames));
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
    const ConfigReader what = ConfigReader::from_file(stage.input("--sample"));
    if (what.has("bodies")) return press_scene(stage, sensor, config, progress);
    if (what.has("fingers")) {
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
