// Checks files against the hashes in the records of earlier stages.
#pragma once

#include <filesystem>

namespace tacipc {

/// Compares an input with the hash that a finished stage's record has of it. Uses the records in the folder of a file,
/// or in an input folder itself, and one folder up. Outputs that differ between runs, and files that no record lists
/// (including records), pass.
/// \param but a record to ignore: the old record of the calling stage
/// \throw DataError naming file and record if a file is not the one that the stage wrote
void refuse_changed_outputs(const std::filesystem::path& input, const std::filesystem::path& but);

}  // namespace tacipc
