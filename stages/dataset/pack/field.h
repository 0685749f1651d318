// What a packed dataset holds: one table of fields, from which datasets, attributes and schema.json all follow.
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

/// Stage and file that a field comes from, and the reader of one frame: in SI or codes, as the stages left them.
struct FieldSource {
  std::string text;
  FieldReader read;
  bool in_variants = false;  // a variant's folder may have it too
  std::string codes = {};    // what the numbers mean, if an enumeration of ours says it
};

/// One field as schema.yaml has it: units, frames and signs of a packed dataset stand there and nowhere else.
struct Field {
  Section section;
  std::string name;
  NumberType type;    // in the file
  std::string shape;  // in letters
  std::string unit;   // in the file
  double per_read;    // how many of `unit` one is of the unit that the source reads
  std::string frame;  // "S", "camera", "image", "world" or "none"
  std::string sign;   // what a positive value means, or "none"
  std::string meaning;
  FieldSource from;
  std::vector<std::pair<std::string, std::string>> more = {};  // further attributes: codes, quat_order
  std::optional<int> step_exponent = std::nullopt;             // the file holds multiples of 2^this, in its unit
  bool per_frame = true;                                       // else one value for the sample, read at frame 0

  /// Of every frame of the press, else of those that were rendered.
  bool of_press_frames() const { return section == Section::series; }
  std::string path() const { return std::string(name_of(section)) + "/" + name; }
};

/// All fields, in the order of schema.yaml.
const std::vector<Field>& fields();

/// Extents of one frame of a field. \pre not Absent
std::vector<std::size_t> shape_of(const FieldData& data);
/// It as the file holds it: scaled, rounded, little-endian. \pre not Absent
std::string bytes_of(const Field& field, const FieldData& data);

/// Attributes of the field's dataset; schema.json has the same lines.
Value::Map attributes_of(const Field& field);

}  // namespace tacipc
