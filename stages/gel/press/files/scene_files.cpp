#include "stages/gel/press/files/scene_files.h"

#include <fmt/core.h>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/sample/pose_file.h"
#include "common/sample/scene_folder.h"
#include "common/stage/record.h"

namespace tacipc {
namespace {

/// File of tetrahedra of a soft body: its mesh, or the one that `tetmesh --object` made from its surface.
std::filesystem::path soft_mesh(const Stage& stage, const BodySpec& body) {
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

/// Checks a file that a body names. \throw UsageError if it is missing
void require_file(const std::filesystem::path& scene, const BodySpec& body, const char* key,
                  const std::filesystem::path& file) {
  if (!file.empty() && !std::filesystem::is_regular_file(file))
    throw UsageError(fmt::format("{}: body {}: {}: {} does not exist", scene.string(), body.name, key, file.string()));
}

/// Reads the files of a body. \param files names and paths that the record should list
SceneBody read_body(Stage& stage, const Sensor& sensor, const TetMesh& gel, const BodySpec& spec,
                    std::vector<std::pair<std::string, std::filesystem::path>>& files) {
  SceneBody body;
  if (!spec.path.empty()) body.path = read_poses(spec.path);
  switch (spec.kind) {
    case BodyKind::gel:
      body.tets = gel;
      body.material = sensor.material;
      break;
    case BodyKind::soft: {
      const std::filesystem::path tets = soft_mesh(stage, spec);
      files.emplace_back(body_input(spec.name), tets);
      files.emplace_back("material_" + spec.name, spec.material);
      body.tets = read_object_tet_mesh(tets);
      body.material = read_config<Material>(spec.material);
      break;
    }
    case BodyKind::rigid:
    case BodyKind::fixed:
      files.emplace_back(body_input(spec.name), spec.mesh);
      body.surface = read_triangle_mesh(spec.mesh, spec.metres_per_unit);
      break;
  }
  return body;
}

/// Text of a scene without its motion and paths.
std::string text_of(const SceneSpec& spec) {
  const auto numbers = [](const auto& matrix) {
    std::string text;
    for (Eigen::Index i = 0; i < matrix.size(); ++i) text += fmt::format(" {}", matrix.data()[i]);
    return text;
  };
  std::string text = "gravity" + numbers(spec.gravity_m_s2);
  for (const BodySpec& body : spec.bodies) {
    text += fmt::format("; {} {} {} {} {}", body.name, static_cast<int>(body.kind), body.metres_per_unit,
                        body.mass.mass_kg.value_or(-1.0), body.mass.density_kg_m3) +
            numbers(body.velocity_m_s) + numbers(body.spin_rad_s);
    if (body.path.empty()) text += numbers(body.world_from_body);
  }
  for (const ContactSpec& contact : spec.contact)
    text += fmt::format("; {} {} {} {}", contact.between[0], contact.between[1], contact.friction.value_or(-1.0),
                        contact.d_hat_m.value_or(-1.0));
  return text;
}

std::string rounded(const Vector3& v) { return fmt::format(" {:.9g} {:.9g} {:.9g}", v.x(), v.y(), v.z()); }

}  // namespace

std::vector<std::string> motion_by_frame(const SceneSpec& spec) {
  std::vector<std::string> all{"\n"};  // frame 0 is the same for every motion
  for (const ScenePhase& phase : spec.motion) {
    for (int frame = 1; frame <= phase.steps; ++frame) {
      const double fraction = static_cast<double>(frame) / phase.steps;
      std::string text = fmt::format("frame {} of a phase; {} steps", frame, phase.substeps);
      for (const WaySpec& move : phase.move) {
        const RigidWay way = move.way * (move.smooth ? smooth_part(fraction) : fraction);
        text += fmt::format("; move {}", move.body) + rounded(way.shift_m) + rounded(way.turn_rad);
      }
      for (const int body : phase.hold) text += fmt::format("; hold {}", body);
      for (const auto& [body, load_n] : phase.load_n)
        text += fmt::format("; load {}", body) + rounded(fraction * load_n);
      all.push_back(text + "\n");
    }
  }
  return all;
}

SceneFiles read_scene(Stage& stage, const Sensor& sensor) {
  if (stage.optional_input("--object") || stage.optional_input("--object-config"))
    throw UsageError("--object and --object-config: the bodies of a scene are named in its file");
  SceneFiles scene{.spec = stage.read_config<SceneSpec>("--sample"), .bodies = {}, .frames = nullptr};
  for (const BodySpec& body : scene.spec.bodies) {
    require_file(stage.input("--sample"), body, "mesh", body.mesh);
    require_file(stage.input("--sample"), body, "material", body.material);
    require_file(stage.input("--sample"), body, "path", body.path);
  }
  const TetMesh gel = read_tet_mesh(stage.input("--gel"));
  std::vector<std::pair<std::string, std::filesystem::path>> files;
  for (const BodySpec& spec : scene.spec.bodies) scene.bodies.push_back(read_body(stage, sensor, gel, spec, files));
  std::string identity;
  for (const auto& [name, file] : files) identity += content_hash(file);
  identity += text_of(scene.spec);
  for (const BodySpec& body : scene.spec.bodies) {
    if (!body.path.empty()) files.emplace_back("path_" + body.name, body.path);
  }
  stage.add_inputs(files);
  if (const auto solved = stage.optional_input("--solved")) {
    for (const char* flag : {"--config", "--sensor", "--gel"}) identity += content_hash(stage.input(flag));
    identity += "\n";
    scene.frames = std::make_unique<SolvedFrames>(stage, *solved, identity, motion_by_frame(scene.spec));
  } else {
    scene.frames = std::make_unique<ScratchFrames>(stage);
  }
  return scene;
}

}  // namespace tacipc
