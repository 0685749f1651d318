#include "stages/dataset/pack/field.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "common/base/packed_units.h"
#include "common/base/rounding.h"
#include "common/config/config.h"
#include "stages/dataset/pack/field_sources.h"
#include "tacipc_pack_texts.h"

namespace tacipc {
namespace {

/// Units of packed datasets, with the factor from the unit of the sources: SI, but mm² and poses in mm.
const std::map<std::string, double> kUnits{
    {"mm", kMmPerM},     {"mm/s", kMmPerM}, {"N", 1.0},        {"N mm", kNmmPerNm}, {"N/mm^2", kNPerMm2PerPa},
    {"deg", kDegPerRad}, {"rad/s", 1.0},    {"s", 1.0},        {"px", 1.0},         {"code", 1.0},
    {"count", 1.0},      {"1", 1.0},        {"relative", 1.0}, {"mm^2", 1.0},       {"mm and 1", 1.0}};

NumberType type_named(const std::string& name) {
  using enum NumberType;
  for (const NumberType type : {u8, i32, f16, f32, f64})
    if (name == name_of(type)) return type;
  throw std::logic_error("schema.yaml: no type is called " + name);
}

Field read_field(ConfigReader& in, Section section, const std::string& name, FieldSource source) {
  Field field{.section = section,
              .name = name,
              .type = type_named(in.text("type")),
              .shape = in.text("shape"),
              .unit = in.text("unit"),
              .per_read = kUnits.at(in.text("unit")),
              .frame = in.text_or("frame", "none"),
              .sign = in.text_or("sign", "none"),
              .meaning = in.text("meaning"),
              .from = std::move(source)};
  if (const auto codes = in.optional_text("codes")) field.more.emplace_back("codes", *codes);
  if (!field.from.codes.empty()) field.more.emplace_back("codes", field.from.codes);
  if (const auto order = in.optional_text("quat_order")) field.more.emplace_back("quat_order", *order);
  if (const auto nan = in.optional_text("nan")) field.more.emplace_back("nan", *nan);
  if (in.has("step_exponent")) field.step_exponent = in.integer("step_exponent", -64, 64);
  field.per_frame = in.flag_or("per_frame", true);
  return field;
}

/// Additional fields for a label of an ensemble: its standard deviation over the members, and its change with their
/// mesh.
std::vector<Field> spreads_of(const Field& label, const std::map<std::string, FieldSource>& sources) {
  Field sigma = label, mesh = label;
  sigma.name += "_sigma";
  sigma.sign = "none";
  sigma.meaning = "standard deviation of " + label.name + " over the members (n - 1)";
  sigma.from = sources.at(sigma.name);
  mesh.name += "_mesh";
  mesh.sign = "positive: more with the coarser mesh";
  mesh.meaning = label.name + " of the sensor in the members' mesh, minus that of the sample";
  mesh.from = sources.at(mesh.name);
  return {sigma, mesh};
}

std::vector<Field> read_fields() {
  std::vector<Field> all;
  ConfigReader in = ConfigReader::from_text(kSchema, "schema.yaml");
  ConfigReader sections = in.section("fields");
  for (const Section section : kSections) {
    const std::map<std::string, FieldSource> sources = field_sources(section);
    ConfigReader listed = sections.section(name_of(section));
    for (const std::string& name : listed.keys()) {
      ConfigReader lines = listed.section(name);
      const Field field = read_field(lines, section, name, sources.at(name));
      all.push_back(field);
      if (section != Section::ensemble) continue;
      for (Field& spread : spreads_of(field, sources)) all.push_back(std::move(spread));
    }
  }
  for (const char* other : {"conventions", "ensemble", "letters"}) in.ignore(other);
  in.finish();
  return all;
}

}  // namespace

const char* name_of(Section section) {
  switch (section) {
    case Section::obs: return "obs";
    case Section::sim: return "sim";
    case Section::check: return "check";
    case Section::series: return "series";
    case Section::ensemble: return "ensemble";
  }
  return "";
}

const std::vector<Field>& fields() {
  static const std::vector<Field> kFields = read_fields();
  return kFields;
}

std::vector<std::size_t> shape_of(const FieldData& data) {
  const auto of_image = [](const auto& image) {
    std::vector<std::size_t> shape{static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)};
    if (image.channels > 1) shape.push_back(static_cast<std::size_t>(image.channels));
    return shape;
  };
  if (const auto* image = std::get_if<FloatImage>(&data)) return of_image(*image);
  if (const auto* image = std::get_if<ByteImage>(&data)) return of_image(*image);
  return std::get<Numbers>(data).shape;
}

std::string bytes_of(const Field& field, const FieldData& data) {
  if (const auto* image = std::get_if<ByteImage>(&data); image && field.type == NumberType::u8 && field.per_read == 1.0)
    return {image->pixels.begin(), image->pixels.end()};
  // Few numbers at a time: all numbers of an image as doubles would exceed the processor's cache.
  constexpr std::size_t kAtOnce = 4096;
  std::string bytes;
  std::vector<double> values;
  const auto add = [&](const auto& numbers) {
    bytes.reserve(numbers.size() * size_of(field.type));
    for (std::size_t first = 0; first < numbers.size(); first += kAtOnce) {
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(first);
      values.assign(begin, begin + static_cast<std::ptrdiff_t>(std::min(kAtOnce, numbers.size() - first)));
      for (double& value : values) value *= field.per_read;
      if (field.step_exponent) round_to(values, *field.step_exponent);
      bytes += to_bytes(field.type, values);
    }
  };
  if (const auto* image = std::get_if<FloatImage>(&data)) add(image->pixels);
  if (const auto* image = std::get_if<ByteImage>(&data)) add(image->pixels);
  if (const auto* numbers = std::get_if<Numbers>(&data)) add(numbers->values);
  return bytes;
}

Value::Map attributes_of(const Field& field) {
  Value::Map lines{{"dtype", name_of(field.type)}, {"shape", field.shape}, {"unit", field.unit},
                   {"frame", field.frame},         {"sign", field.sign},   {"meaning", field.meaning},
                   {"source", field.from.text}};
  for (const auto& [name, text] : field.more) lines.emplace_back(name, text);
  if (field.step_exponent) lines.emplace_back("step", std::ldexp(1.0, *field.step_exponent));
  return lines;
}

}  // namespace tacipc
