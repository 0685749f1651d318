// Which fields a shard holds.
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
  static PackConfig read(ConfigReader& in);
};

}  // namespace tacipc
