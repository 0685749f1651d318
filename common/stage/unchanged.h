// Checks whether a finished stage's inputs and outputs are unchanged.
#pragma once

#include <filesystem>

namespace tacipc {

/// Returns whether every input that a record names has the same content, whatever its date, and every output exists.
/// False if there is no readable record.
bool is_unchanged(const std::filesystem::path& record);

}  // namespace tacipc
