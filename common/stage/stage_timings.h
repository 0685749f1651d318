// Cost of a stage's run, as `<stage>.timings.yaml` beside its record says.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tacipc {

struct StageTimings {
  std::string stage;
  double processor_s = 0.0;
  double wall_s = 0.0;
  double peak_memory_mb = 0.0;
};

/// \throw DataError if the file cannot be read or a number is missing
StageTimings read_timings(const std::filesystem::path& file);
/// The timings beside a record: `press/press.yaml` → `press/press.timings.yaml`.
StageTimings read_timings_of(const std::filesystem::path& record);

/// Common folder of these files, at most their parent folders: names further up tell nothing about them.
std::filesystem::path common_folder(const std::vector<std::filesystem::path>& files);

/// Whether a folder on the path below `root` has this name, or ends with it after a hyphen (`mctac-adaptive_0100um`).
/// \pre the path begins with `root`, as of common_folder
bool lies_in(const std::filesystem::path& path, const std::string& folder, const std::filesystem::path& root = {});

}  // namespace tacipc
