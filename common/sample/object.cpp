#include "common/sample/object.h"

#include <fmt/core.h>

#include "common/sample/placement.h"

namespace tacipc {

ObjectSpec ObjectSpec::read(ConfigReader& in) {
  ObjectSpec spec;
  spec.unit = in.choice("unit", {"m", "cm", "mm", "um", "in", kAutoUnit});
  if (in.has("up")) spec.up = in.choice("up", face_names());
  if (in.text_or("scale", "1") == "fit")
    spec.fit_window = true;
  else
    spec.scale = in.number_or("scale", spec.scale, Range::positive());
  if (const auto thickness = in.optional_number("sheet_thickness_mm", Range::between(1e-3, 100.0)))
    spec.sheet_thickness_m = 1e-3 * *thickness;
  if (in.has("height_field")) {
    ConfigReader field = in.section("height_field");
    std::vector<std::string> sides = face_names();
    sides.push_back(SideConfig::kMostRelief);
    spec.height_field = SideConfig{.side = field.choice("side", sides)};
    spec.height_field->spacing_m = 1e-3 * field.number_or("spacing_mm", 0.05, Range::between(1e-3, 10.0));
  }
  return spec;
}

std::string ObjectSpec::yaml() const {
  std::string text = fmt::format("unit: {}\n", unit);
  if (up) text += fmt::format("up: \"{}\"\n", *up);
  if (fit_window) text += "scale: fit\n";
  if (scale != 1.0) text += fmt::format("scale: {}\n", scale);
  if (sheet_thickness_m) text += fmt::format("sheet_thickness_mm: {}\n", 1e3 * *sheet_thickness_m);
  if (height_field)
    text += fmt::format("height_field: {{side: \"{}\", spacing_mm: {}}}\n", height_field->side,
                        1e3 * height_field->spacing_m);
  return text;
}

}  // namespace tacipc
