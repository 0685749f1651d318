// Files that the records of earlier stages vouch for.
#pragma once

#include <filesystem>

namespace tacipc {

/// Compares an input with the hash that a finished stage's record has of it. Looked at are the records in the folder of
/// a file, or in an input folder itself, and one folder up; outputs that differ between runs, and files that no record
/// lists, records among them, pass. `but` is a record that does not count: the old one of the stage that asks.
/// \throw DataError naming file and record if a file is not the one that the stage wrote
void refuse_changed_outputs(const std::filesystem::path& input, const std::filesystem::path& but);

}  // namespace tacipc
