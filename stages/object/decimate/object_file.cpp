#include "stages/object/decimate/object_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "common/base/text_reader.h"
#include "stages/object/decimate/doctor_steps.h"
#include "stages/object/decimate/scene_file.h"

namespace tacipc {
namespace {

constexpr std::array kUnits{"um", "mm", "cm", "in", "m"};

}  // namespace

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

double scale_to_window(const TriangleMesh& mesh, const SensorWindow& window, const std::string& wanted) {
  constexpr double kFilled = 0.9;
  const double window_m = kFilled * std::min(window.size_m[0], window.size_m[1]);
  double scale = window_m / largest_extent(mesh);
  // Which side shows most depends on the size: first as large as fits whole, then as this side fits.
  TriangleMesh scaled = mesh;
  scaled.positions *= scale;
  const SideView side = survey_sides(scaled, window, wanted).side();
  return scale * kFilled * std::min(window.size_m[0] / side.extent_m[0], window.size_m[1] / side.extent_m[1]);
}

std::string units_that_fit(double extent_m, const std::string& unit, double wanted_m) {
  constexpr double kAbout = 3.0;
  std::string fitting;
  for (const char* other : kUnits) {
    const double extent = extent_m * metres_per_unit(other) / metres_per_unit(unit);
    if (other == unit || extent * kAbout < wanted_m || extent > kAbout * wanted_m) continue;
    fitting += fmt::format("{}in {} it is {:.3g} mm wide", fitting.empty() ? "" : ", ", other, 1e3 * extent);
  }
  return fitting.empty() ? "" : " (" + fitting + ")";
}

}  // namespace tacipc
