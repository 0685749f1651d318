#include <fmt/core.h>
#include <malloc.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>

#include "common/base/checked_file.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/sample/pose_file.h"
#include "common/sample/sample_inputs.h"
#include "common/sample/scene_folder.h"
#include "common/stage/record.h"
#include "common/stage/stage.h"
#include "stages/gel/press/drive/checkpoint.h"
#include "stages/gel/press/files/outputs.h"

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

/// Frames of a grasp or a scene as scratch files of the stage.
class ScratchBytes : public tacipc::ByteStore {
 public:
  explicit ScratchBytes(tacipc::Stage& stage) : stage_(stage) {}
  void save(const std::string& bytes) override { stage_.save_scratch(name(), bytes), ++next_; }
  std::optional<std::string> load() override {
    auto bytes = stage_.load_scratch(name());
    if (bytes) ++next_;
    return bytes;
  }

 protected:
  std::string name() const { return fmt::format("bodies_{:05d}", next_); }
  tacipc::Stage& stage_;
  int next_ = 0;
};

/// The same of a scene that is solved piece by piece: the first frames are those of a folder, others are left to it.
class SolvedBytes final : public ScratchBytes {
 public:
  /// \param identity of all that a scene's frames depend on but its motion
  SolvedBytes(tacipc::Stage& stage, std::filesystem::path folder, std::string identity)
      : ScratchBytes(stage), folder_(std::move(folder)), identity_(std::move(identity)) {}
  void save(const std::string& bytes) override {
    keep(bytes);
    ScratchBytes::save(bytes);
  }
  std::optional<std::string> load() override {
    if (const auto file = folder_ / name(); std::filesystem::is_regular_file(file)) {
      auto bytes = tacipc::read_checked_file(file);
      if (!bytes || bytes->compare(0, identity_.size(), identity_) != 0)
        throw tacipc::DataError("{}: is damaged, or of another gel, sensor, press file, body or contact",
                                file.string());
      ++next_;
      return bytes->substr(identity_.size());
    }
    auto bytes = stage_.load_scratch(name());
    if (bytes) keep(*bytes), ++next_;
    return bytes;
  }

 private:
  void keep(const std::string& bytes) {
    tacipc::write_checked_file(stage_.output("solved/" + name()), identity_ + bytes);
  }
  std::filesystem::path folder_;
  std::string identity_;
};

/// Newton's method allocates and frees the same few megabytes in every iteration. Given back to the system each time,
/// up to a tenth of the run would be spent on zeroed pages.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_TOP_PAD, 64 << 20);
}

/// The solver goes through tens of megabytes again and again: on huge pages a press takes a tenth less time. glibc asks
/// for them only if the environment says so when a program starts, so this one starts once more.
void ask_for_huge_pages(char** argv) {
  constexpr const char* kVariable = "GLIBC_TUNABLES";
  if (std::getenv(kVariable) != nullptr) return;
  setenv(kVariable, "glibc.malloc.hugetlb=1", 1);
  std::error_code unreadable;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unreadable);
  if (!unreadable) execv(program.c_str(), argv);  // where that fails this one goes on
}

/// The file of tetrahedra of a soft body: its mesh, or what `tetmesh --object` made of its surface.
std::filesystem::path soft_mesh(const tacipc::Stage& stage, const tacipc::BodySpec& body) {
  using namespace tacipc;
  if (body.mesh.extension() == ".msh") return body.mesh;
  const auto folder = stage.optional_input("--soft");
  if (!folder)
    throw UsageError(fmt::format("body {}: {} is a surface: --soft must be the folder with what tetmesh made of it",
                                 body.name, body.mesh.string()));
  const std::filesystem::path made = *folder / body.name, record = made / "tetmesh.yaml";
  if (!std::filesystem::is_regular_file(record))
    throw UsageError(fmt::format("body {}: {} is a surface, of which tetmesh has made no {}", body.name,
                                 body.mesh.string(), (made / "object.msh").string()));
  const auto of = Record::from_file(record).section("inputs").section("object").text("hash");
  if (of != content_hash(body.mesh))
    throw DataError("body {}: {} is of another surface than {}", body.name, record.string(), body.mesh.string());
  return made / "object.msh";
}

/// \throw UsageError if a file that a body names is not there
void require_file(const std::filesystem::path& scene, const tacipc::BodySpec& body, const char* key,
                  const std::filesystem::path& file) {
  if (!file.empty() && !std::filesystem::is_regular_file(file))
    throw tacipc::UsageError(
        fmt::format("{}: body {}: {}: {} does not exist", scene.string(), body.name, key, file.string()));
}

void read_path(const tacipc::BodySpec& spec, tacipc::SceneBody& body) {
  if (!spec.path.empty()) body.path = tacipc::read_poses(spec.path);
}

/// All that a scene says but its motion and paths.
std::string text_of(const tacipc::SceneSpec& spec) {
  const auto numbers = [](const auto& matrix) {
    std::string text;
    for (Eigen::Index i = 0; i < matrix.size(); ++i) text += fmt::format(" {}", matrix.data()[i]);
    return text;
  };
  std::string text = "gravity" + numbers(spec.gravity_m_s2);
  for (const tacipc::BodySpec& body : spec.bodies) {
    text += fmt::format("; {} {} {} {} {}", body.name, static_cast<int>(body.kind), body.metres_per_unit,
                        body.mass.mass_kg.value_or(-1.0), body.mass.density_kg_m3) +
            numbers(body.velocity_m_s) + numbers(body.spin_rad_s);
    if (body.path.empty()) text += numbers(body.world_from_body);
  }
  for (const tacipc::ContactSpec& contact : spec.contact)
    text += fmt::format("; {} {} {} {}", contact.between[0], contact.between[1], contact.friction.value_or(-1.0),
                        contact.d_hat_m.value_or(-1.0));
  return text;
}

void press_scene(tacipc::Stage& stage, const tacipc::Sensor& sensor, const tacipc::PressConfig& config,
                 const tacipc::ProgressObserver& progress) {
  using namespace tacipc;
  if (stage.optional_input("--object") || stage.optional_input("--object-config"))
    throw UsageError("--object and --object-config: the bodies of a scene are named in its file");
  const auto spec = stage.read_config<SceneSpec>("--sample");
  for (const BodySpec& body : spec.bodies) {
    require_file(stage.input("--sample"), body, "mesh", body.mesh);
    require_file(stage.input("--sample"), body, "material", body.material);
    require_file(stage.input("--sample"), body, "path", body.path);
  }
  const TetMesh gel = read_tet_mesh(stage.input("--gel"));
  std::vector<SceneBody> bodies;
  std::vector<std::pair<std::string, std::filesystem::path>> files;
  for (const BodySpec& spec_of : spec.bodies) {
    SceneBody& body = bodies.emplace_back();
    switch (spec_of.kind) {
      case BodyKind::gel:
        body.tets = gel;
        body.material = sensor.material;
        read_path(spec_of, body);
        break;
      case BodyKind::soft: {
        const std::filesystem::path tets = soft_mesh(stage, spec_of);
        files.emplace_back(body_input(spec_of.name), tets);
        files.emplace_back("material_" + spec_of.name, spec_of.material);
        body.tets = read_object_tet_mesh(tets);
        body.material = read_config<Material>(spec_of.material);
        break;
      }
      case BodyKind::rigid:
      case BodyKind::fixed:
        files.emplace_back(body_input(spec_of.name), spec_of.mesh);
        body.surface = read_triangle_mesh(spec_of.mesh, spec_of.metres_per_unit);
        read_path(spec_of, body);
        break;
    }
  }
  std::string identity;
  for (const auto& [name, file] : files) identity += content_hash(file);
  identity += text_of(spec);
  for (const BodySpec& body : spec.bodies) {
    if (!body.path.empty()) files.emplace_back("path_" + body.name, body.path);
  }
  stage.add_inputs(files);
  std::unique_ptr<ScratchBytes> frames;
  if (const auto solved = stage.optional_input("--solved")) {
    for (const char* flag : {"--config", "--sensor", "--gel"}) identity += content_hash(stage.input(flag));
    frames = std::make_unique<SolvedBytes>(stage, *solved, identity);
  } else {
    frames = std::make_unique<ScratchBytes>(stage);
  }
  write_outputs(stage, sensor, bodies, config, spec, run_scene(sensor, bodies, config, spec, progress, frames.get()));
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
      return press_scene(stage, sensor, file, progress);
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
      ScratchBytes frames(stage);
      write_outputs(stage, sensor, gel, grasp(sensor, gel, object, config, spec, progress, &frames));
      return;
    }
    tell_friction();
    const SampleInputs inputs = read_sample(stage);
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    ScratchFrames frames(stage);
    const Simulation simulation =
        simulate(sensor, gel, inputs.object, config, inputs.sample, inputs.face, progress, &frames);
    write_outputs(stage, sensor, gel, config, inputs.sample, simulation);
  });
}
