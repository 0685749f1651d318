// Selects the fields of a shard, and makes schema.json.
#pragma once

#include <vector>

#include "common/config/config.h"
#include "stages/dataset/pack/field.h"

namespace tacipc {

/// Profile of a packed dataset, from configs/datasets/pack/*.yaml.
struct PackConfig {
  std::vector<const Field*> packed;  // packed fields, in the order of the table
  bool variants = false;             // also pack the render's variants
  bool list_unmade = false;  // list samples without record and failure in failures.csv; false: they are an error

  bool packs(const Field& field) const;
  /// Content of schema.json: name and version of the format, conventions, meanings of the letters in shapes, and each
  /// field with its attributes and whether this dataset packs it.
  Value schema(bool with_ensemble) const;
  static PackConfig read(ConfigReader& in);
};

}  // namespace tacipc
