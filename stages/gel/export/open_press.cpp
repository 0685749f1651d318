#include "stages/gel/export/open_press.h"

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/config/config.h"
#include "common/sample/scene_folder.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// \throw DataError if `path` is not the file that the record names under this input.
void check_input(const fs::path& record_path, const ConfigReader& record, const char* input, const fs::path& path) {
  ConfigReader in = record;
  const std::string hash = in.section("inputs").section(input).text("hash");
  if (hash != content_hash(path))
    throw DataError("{}: is not the {} that {} was made with", path.string(), input, record_path.string());
}

}  // namespace

PressFolder open_press(const fs::path& folder, const fs::path& gel_path, const TetMesh& gel,
                       const fs::path& object_path, std::optional<std::size_t> frames) {
  Extents known{{kVertices, static_cast<std::size_t>(gel.num_vertices())}};
  if (frames) known.emplace(kFrames, *frames);
  PressFolder press = PressFolder::finished(folder, std::move(known));
  const fs::path record_path = folder / "press.yaml";
  const ConfigReader record = ConfigReader::from_file(record_path);
  check_input(record_path, record, "gel", gel_path);
  check_input(record_path, record, "object", object_path);
  press.require_front(gel.vertices(BoundaryTag::front));
  using enum PressArray;
  press.require({positions, time, object_pose, contact_force, contact_state});
  return press;
}

OpenScene open_scene(const fs::path& folder, const fs::path& gel_path, const fs::path& object_path) {
  const TetMesh gel = read_tet_mesh(gel_path);
  const TriangleMesh object = read_triangle_mesh(object_path, 1.0);
  OpenScene open;
  if (!is_scene_folder(folder)) {
    PressFolder press = open_press(folder, gel_path, gel, object_path);
    open.times_s = press.times();
    open.objects.push_back({"", object, press.poses()});
    open.gels.push_back({"", gel, std::move(press), {}});
    return open;
  }
  SceneFolder scene = read_scene_folder(folder);
  for (SceneGel& placed : scene.gels) {
    PressFolder press = open_press(placed.press(), gel_path, gel, object_path, scene.times_s.size());
    open.gels.push_back({placed.name, gel, std::move(press), std::move(placed.world_from_gel)});
  }
  for (SceneObject& placed : scene.objects)
    open.objects.push_back({scene.objects.size() > 1 ? placed.name : "", object, std::move(placed.world_from_object)});
  open.times_s = std::move(scene.times_s);
  return open;
}

}  // namespace tacipc
