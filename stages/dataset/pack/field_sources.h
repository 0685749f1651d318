// Sources of the fields of a packed dataset: each names a file of a sample and reads one frame of it.
#pragma once

#include <map>
#include <string>

#include "stages/dataset/pack/field.h"

namespace tacipc {

/// Sources of all fields of a section, by field name.
std::map<std::string, FieldSource> field_sources(Section section);

}  // namespace tacipc
