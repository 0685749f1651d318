#include "stages/gel/export/open_press.h"

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/config/config.h"

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
                       const fs::path& object_path) {
  PressFolder press = PressFolder::finished(folder, {{kVertices, static_cast<std::size_t>(gel.num_vertices())}});
  const fs::path record_path = folder / "press.yaml";
  const ConfigReader record = ConfigReader::from_file(record_path);
  check_input(record_path, record, "gel", gel_path);
  check_input(record_path, record, "object", object_path);
  press.require_front(gel.vertices(BoundaryTag::front));
  using enum PressArray;
  press.require({positions, time, object_pose, contact_force, contact_state});
  return press;
}

}  // namespace tacipc
