// The table of a plan, for those who read it while another run may be planning anew.
#pragma once

#include <filesystem>
#include <string>

namespace tacipc {

/// Waits, at most ten minutes, while somebody holds the lock of the stage plan. Returns whether nobody does.
bool wait_for_plan(const std::filesystem::path& dataset);

/// The table. \throw DataError if there is none yet
std::filesystem::path samples_table(const std::filesystem::path& dataset);

/// Last part of a dataset's folder, as messages name it.
std::string name_of_dataset(const std::filesystem::path& dataset);

}  // namespace tacipc
