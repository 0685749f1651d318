#include "common/sample/object.h"

#include <fmt/ranges.h>

#include "common/sample/placement.h"

namespace tacipc {
namespace {

WrapConfig read_wrap(ConfigReader in, bool fit_window) {
  WrapConfig wrap;
  const auto alpha_mm = in.optional_number("alpha_mm", Range::positive());
  const auto relative =
      in.optional_number("relative_alpha", Range::between(WrapConfig::kFinest, WrapConfig::kCoarsest));
  const auto offset_mm = in.optional_number("offset_mm", Range::positive());
  if (alpha_mm && relative) in.fault("alpha_mm", "say it or relative_alpha");
  // The size of a millimetre in the mesh is known only after wrapping.
  for (const char* key : {"alpha_mm", "offset_mm"})
    if (fit_window && in.has(key)) in.fault(key, "scale: fit takes no lengths; leave it out");
  if (alpha_mm) wrap.alpha_m = 1e-3 * *alpha_mm;
  if (offset_mm) wrap.offset_m = 1e-3 * *offset_mm;
  wrap.relative_alpha = relative.value_or(wrap.relative_alpha);
  return wrap;
}

std::string wrap_yaml(const WrapConfig& wrap) {
  std::vector<std::string> keys;
  if (wrap.alpha_m)
    keys.push_back(fmt::format("alpha_mm: {}", 1e3 * *wrap.alpha_m));
  else if (wrap.relative_alpha != WrapConfig{}.relative_alpha)
    keys.push_back(fmt::format("relative_alpha: {}", wrap.relative_alpha));
  if (wrap.offset_m) keys.push_back(fmt::format("offset_mm: {}", 1e3 * *wrap.offset_m));
  return fmt::format("wrap: {{{}}}\n", fmt::join(keys, ", "));
}

}  // namespace

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
  if (in.has("wrap")) spec.wrap = read_wrap(in.section("wrap"), spec.fit_window);
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
  if (wrap) text += wrap_yaml(*wrap);
  if (height_field)
    text += fmt::format("height_field: {{side: \"{}\", spacing_mm: {}}}\n", height_field->side,
                        1e3 * height_field->spacing_m);
  return text;
}

}  // namespace tacipc
