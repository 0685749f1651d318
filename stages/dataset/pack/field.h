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

const char* name_of(Section section);

/// Unit of a packed dataset, and how many of it one is of the unit that a field is read in.
struct PackedUnit {
  const char* name;
  double per_read = 1.0;
};

/// Numbers of a field as the file holds them. The shape is in letters: T packed frames, P frames of the press, H rows,
/// W columns of the image, h, w of the grid, N markers, V, F.
struct FieldNumbers {
  NumberType type;
  const char* shape;
  PackedUnit unit;
};

/// Frame of reference ("S", "camera", "image", "world"), and what a positive value means.
struct FieldAxes {
  const char *frame = "none", *sign = "none";
};

using FieldReader = std::function<FieldData(SampleFrames& sample, std::size_t frame)>;

/// Stage and file that a field comes from, and the reader of one frame: in SI or codes, as the stages left them.
struct FieldSource {
  std::string text;
  FieldReader read;
  bool in_variants = false;  // a variant's folder may have it too
};

struct FieldExtra {
  std::vector<std::pair<std::string, std::string>> more = {};  // further attributes: codes, quat_order
  std::optional<int> step_exponent = std::nullopt;             // the file holds multiples of 2^this, in its unit
  bool per_frame = true;                                       // else one value for the sample, read at frame 0
};

/// One field. Units, frames and signs of a packed dataset stand in the table of fields and nowhere else.
struct Field {
  std::string name;
  FieldNumbers numbers;
  FieldAxes axes;
  std::string meaning;
  FieldSource from;
  FieldExtra extra = {};
  Section section = Section::obs;

  /// Of every frame of the press, else of those that were rendered.
  bool of_press_frames() const { return section == Section::series; }
  std::string path() const { return std::string(name_of(section)) + "/" + name; }
};

const std::vector<Field>& fields();

/// Extents of one frame of a field. \pre not Absent
std::vector<std::size_t> shape_of(const FieldData& data);
/// It as the file holds it: scaled, rounded, little-endian. \pre not Absent
std::string bytes_of(const Field& field, const FieldData& data);

/// Attributes of the field's dataset; schema.json has the same lines.
Value::Map attributes_of(const Field& field);

}  // namespace tacipc
