// Whether a finished stage would find again what it found.
#pragma once

#include <filesystem>

namespace tacipc {

/// True if every input that a record names has the content it had, whatever its date, and every output is there. False
/// where there is no record, or none that can be read.
bool is_unchanged(const std::filesystem::path& record);

}  // namespace tacipc
