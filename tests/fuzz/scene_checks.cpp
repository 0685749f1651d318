#include <array>
#include <cstring>
#include <stdexcept>

#include "common/mesh/scene_file.h"
#include "tests/common/zip_file.h"
#include "tests/fuzz/reader_checks.h"

namespace tacipc {
namespace {

/// First byte from `from` on of a record of a ZIP archive: "PK" and a pair of small numbers.
std::size_t next_record(std::string_view bytes, std::size_t from) {
  for (std::size_t at = bytes.find("PK", from); at != std::string_view::npos; at = bytes.find("PK", at + 1))
    if (at + 4 <= bytes.size() && bytes[at + 2] > 0 && bytes[at + 2] < 9 && bytes[at + 3] == bytes[at + 2] + 1)
      return at;
  return bytes.size();
}

std::size_t short_at(std::string_view bytes, std::size_t at) {
  std::uint16_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

}  // namespace

void check_scene(const std::filesystem::path& file) {
  const SceneMesh scene = read_scene_file(file);
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  require(metres_per_unit(scene.unit) > 0.0, "a mesh without a unit");
  require(scene.mesh.num_triangles() > 0, "a mesh without triangles");
  require(scene.mesh.positions.allFinite(), "positions that are not finite");
  require(scene.mesh.triangles.minCoeff() >= 0 && scene.mesh.triangles.maxCoeff() < scene.mesh.num_vertices(),
          "a triangle of a vertex that is not there");
}

std::string zip_made_whole(std::string_view bytes) {
  constexpr std::size_t kHeader = 30, kNameLength = 26, kExtraLength = 28;
  NamedFiles files;
  for (std::size_t at = next_record(bytes, 0); at < bytes.size();) {
    const std::size_t end = next_record(bytes, at + 4);
    if (bytes[at + 2] == 3 && at + kHeader <= end) {
      const std::size_t name = std::min(short_at(bytes, at + kNameLength), end - at - kHeader);
      const std::size_t extra = std::min(short_at(bytes, at + kExtraLength), end - at - kHeader - name);
      std::string path(bytes.substr(at + kHeader, name));
      std::erase(path, '\0');
      files.emplace_back(path.empty() ? "x" : path,
                         bytes.substr(at + kHeader + name + extra, end - at - kHeader - name - extra));
    }
    at = end;
  }
  return zip_of(files, ZipMethod::store);
}

}  // namespace tacipc
