// Table of a plan, for readers while another run may be planning again.
#pragma once

#include <filesystem>
#include <string>

namespace tacipc {

/// Waits while somebody holds the lock of the stage plan, at most ten minutes.
/// \return true if the lock is free
bool wait_for_plan(const std::filesystem::path& dataset);

/// Path of the table.
/// \throw DataError if there is none yet
std::filesystem::path samples_table(const std::filesystem::path& dataset);

/// Last component of a dataset's folder, as messages name it.
std::string name_of_dataset(const std::filesystem::path& dataset);

}  // namespace tacipc
