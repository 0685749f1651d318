// Which fields a shard holds, and what schema.json says of them.
#pragma once

#include <vector>

#include "common/config/config.h"
#include "stages/dataset/pack/field.h"

namespace tacipc {

struct PackConfig {
  std::vector<const Field*> packed;  // in the order of the table
  bool variants = false;             // the render's variants too
  bool list_unmade = false;          // samples without record and failure go to failures.csv instead of being refused

  bool packs(const Field& field) const;
  /// schema.json: name and version of the format, conventions, what the letters of shapes mean, and each field with its
  /// attributes and whether this dataset packs it.
  Value schema(bool with_ensemble) const;
  static PackConfig read(ConfigReader& in);
};

}  // namespace tacipc
