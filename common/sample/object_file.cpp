#include "common/sample/object_file.h"

#include <algorithm>
#include <cctype>

#include "common/base/text_reader.h"
#include "common/mesh/scene_file.h"

namespace tacipc {

std::optional<std::string> unit_in_name(const std::filesystem::path& path) {
  const std::string stem = lower_case(path.stem().string());
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto word = std::find_if_not(stem.rbegin(), stem.rend(), is_letter).base();
  const std::string last(word, stem.end());
  if (word == stem.begin()) return std::nullopt;
  if (last == "mm" || last == "cm" || last == "um") return last;
  if (last == "inch" || last == "inches") return "in";
  if (last == "meters" || last == "metres" || last == "meter" || last == "metre") return "m";
  return std::nullopt;
}

ObjectFile read_object_file(const std::filesystem::path& path, const ObjectSpec& spec) {
  ObjectFile object{.mesh = {}, .unit = spec.unit, .unit_from = "object file"};
  const bool automatic = spec.unit == ObjectSpec::kAutoUnit;
  if (is_scene_file(path)) {
    SceneMesh scene = read_scene_file(path);
    if (automatic) object.unit = scene.unit, object.unit_from = "mesh format";
    object.mesh = std::move(scene.mesh);
    object.mesh.positions *= spec.scale * metres_per_unit(object.unit);
    return object;
  }
  if (automatic) {
    const auto named = unit_in_name(path);
    object.unit = named.value_or("mm");
    object.unit_from = named ? "file name" : "default";
  }
  object.mesh = read_triangle_mesh(path, spec.scale * metres_per_unit(object.unit));
  return object;
}

}  // namespace tacipc
