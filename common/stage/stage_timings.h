// Cost of a stage's run, as `<stage>.timings.yaml` beside its record says.
#pragma once

#include <filesystem>
#include <string>

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

}  // namespace tacipc
