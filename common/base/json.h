// Writes values as JSON text (RFC 8259), for programs outside this project.
#pragma once

#include <string>

#include "common/base/value.h"

namespace tacipc {

/// Returns JSON indented by two blanks, lists without maps on one line, numbers in the shortest form that reads back to
/// the same bits: 0.0 for a double, 0 for a whole number. Numbers that are not finite become null, because JSON has
/// none.
std::string to_json(const Value& value);

}  // namespace tacipc
