// Sources of the fields of a packed dataset: each names the file of a sample and reads one frame of it.
#pragma once

#include <map>
#include <string>

#include "stages/dataset/pack/field.h"

namespace tacipc {

/// Of every field of a section, by the field's name.
std::map<std::string, FieldSource> field_sources(Section section);

}  // namespace tacipc
