// Table of the fields of a packed dataset. Datasets, attributes and schema.json all follow from it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/base/value.h"
#include "common/format/hdf5_writer.h"
#include "stages/dataset/pack/sample_frames.h"

namespace tacipc {

/// Part of a sample's group.
enum class Section { obs, sim, check, series, ensemble };
inline constexpr Section kSections[] = {Section::obs, Section::sim, Section::check, Section::series, Section::ensemble};

const char* name_of(Section section);

using FieldReader = std::function<FieldData(SampleFrames& sample, std::size_t frame)>;

/// Source of a field: stage and file, and a reader of one frame in the stages' own units (SI or 8-bit values).
struct FieldSource {
  std::string text;
  FieldReader read;
  bool in_variants = false;  // a variant's folder may also hold it
  std::string codes = {};    // meaning of the numbers, if an enumeration defines it
};

/// One field as in schema.yaml, the only place that defines units, frames and signs of a packed dataset.
struct Field {
  Section section;
  std::string name;
  NumberType type;    // type in the file
  std::string shape;  // shape as letters
  std::string unit;   // unit in the file
  double per_read;    // factor from the source's unit to `unit`
  std::string frame;  // "S", "camera", "image", "world" or "none"
  std::string sign;   // meaning of a positive value, or "none"
  std::string meaning;
  FieldSource from;
  std::vector<std::pair<std::string, std::string>> more = {};  // further attributes: codes, quat_order
  std::optional<int> step_exponent = std::nullopt;             // the file holds multiples of 2^step_exponent, in `unit`
  bool per_frame = true;                                       // false: one value for the sample, read at frame 0

  /// True: the field has every frame of the press; false: only the rendered frames.
  bool of_press_frames() const { return section == Section::series; }
  std::string path() const { return std::string(name_of(section)) + "/" + name; }
};

/// All fields, in the order of schema.yaml.
const std::vector<Field>& fields();

/// Shape of one frame of a field.
/// \pre not Absent
std::vector<std::size_t> shape_of(const FieldData& data);
/// Bytes of a frame as the file holds it: scaled, rounded, little-endian.
/// \pre not Absent
std::string bytes_of(const Field& field, const FieldData& data);

/// Attributes of the field's dataset; schema.json has the same lines.
Value::Map attributes_of(const Field& field);

}  // namespace tacipc
