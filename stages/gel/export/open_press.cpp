#include "stages/gel/export/open_press.h"

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/config/config.h"
#include "common/sample/scene_folder.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kObject = "object";  // name of this input in the record of a press or a grasp

/// Checks an input file. \throw DataError if `path` is not the file that the record names under this input
void check_input(const fs::path& record_path, const ConfigReader& record, const std::string& input,
                 const fs::path& path) {
  ConfigReader in = record;
  const std::string hash = in.section("inputs").section(input).text("hash");
  if (hash != content_hash(path))
    throw DataError("{}: is not the {} that {} was made with", path.string(), input, record_path.string());
}

/// Path of a body's mesh according to the record. \throw DataError if the file is missing or has changed
fs::path recorded_input(const fs::path& folder, const std::string& input) {
  const fs::path record_path = folder / "press.yaml";
  ConfigReader record = ConfigReader::from_file(record_path);
  const fs::path path = (folder / record.section("inputs").section(input).text("path")).lexically_normal();
  check_input(record_path, record, input, path);
  return path;
}

const fs::path& given(const std::optional<fs::path>& object_path) {
  if (!object_path) throw UsageError("--object is missing: only the record of a scene names its bodies");
  return *object_path;
}

}  // namespace

PressFolder open_press(const fs::path& folder, const fs::path& gel_path, const TetMesh& gel,
                       const std::optional<fs::path>& object_path, std::optional<std::size_t> frames) {
  Extents known{{kVertices, static_cast<std::size_t>(gel.num_vertices())}};
  if (frames) known.emplace(kFrames, *frames);
  PressFolder press = PressFolder::finished(folder, std::move(known));
  const fs::path record_path = folder / "press.yaml";
  const ConfigReader record = ConfigReader::from_file(record_path);
  check_input(record_path, record, "gel", gel_path);
  if (object_path) check_input(record_path, record, kObject, *object_path);
  press.require_front(gel.vertices(BoundaryTag::front));
  using enum PressArray;
  press.require({positions, time, object_pose, contact_force, contact_state});
  return press;
}

OpenScene open_scene(const fs::path& folder, const fs::path& gel_path, const std::optional<fs::path>& object_path) {
  const TetMesh gel = read_tet_mesh(gel_path);
  OpenScene open;
  if (!is_scene_folder(folder)) {
    const TriangleMesh object = read_triangle_mesh(given(object_path), 1.0);
    PressFolder press = open_press(folder, gel_path, gel, object_path);
    open.times_s = press.times();
    open.objects.push_back({"", object, press.poses()});
    open.gels.push_back({"", gel, std::move(press), {}});
    return open;
  }
  SceneFolder scene = read_scene_folder(folder);
  const bool of_bodies = scene.objects.empty() || scene.objects.front().input != kObject;
  if (of_bodies && object_path) throw UsageError("--object: the record of a scene names its bodies");
  for (SceneGel& placed : scene.gels) {
    PressFolder press = open_press(placed.press(), gel_path, gel, object_path, scene.times_s.size());
    open.gels.push_back({placed.name, gel, std::move(press), std::move(placed.world_from_gel)});
  }
  for (SceneObject& placed : scene.objects) {
    const fs::path file = of_bodies ? recorded_input(folder, placed.input) : given(object_path);
    open.objects.push_back({of_bodies ? placed.name : "", read_triangle_mesh(file, placed.metres_per_unit),
                            std::move(placed.world_from_object)});
  }
  for (const SceneSoft& soft : scene.soft) {
    TetMesh mesh = read_object_tet_mesh(recorded_input(folder, soft.input));
    std::vector<Positions> positions =
        soft.positions(scene.times_s.size(), static_cast<std::size_t>(mesh.num_vertices()));
    open.soft.push_back({soft.name, std::move(mesh), std::move(positions)});
  }
  open.times_s = std::move(scene.times_s);
  return open;
}

}  // namespace tacipc
