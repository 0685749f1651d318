#include "common/mesh/scene_file.h"

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/text_reader.h"
#include "common/mesh/scene_parts.h"

namespace tacipc {
namespace {

std::string suffix_of(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

}  // namespace

bool is_scene_file(const std::filesystem::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".glb" || suffix == ".gltf" || suffix == ".3mf";
}

SceneMesh read_scene_file(const std::filesystem::path& path) {
  // Read from memory, so that the parsed bytes are the hashed ones, and no other file is read.
  const std::string name = path.string(), bytes = read_file(path);
  if (bytes.empty()) throw DataError("{}: the file is empty", name);
  return suffix_of(path) == ".3mf" ? read_3mf(bytes, name) : read_gltf(bytes, name);
}

}  // namespace tacipc
