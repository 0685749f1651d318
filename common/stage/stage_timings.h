// Cost of a stage's run, read from `<stage>.timings.yaml` next to its record.
#pragma once

#include <filesystem>
#include <string>

namespace tacipc {

/// Times and memory of a run.
struct StageTimings {
  std::string stage;
  double processor_s = 0.0;
  double wall_s = 0.0;
  double peak_memory_mb = 0.0;
};

/// Reads a timings file.
/// \throw DataError if the file cannot be read or a number is missing
StageTimings read_timings(const std::filesystem::path& file);
/// Reads the timings next to a record: `press/press.yaml` → `press/press.timings.yaml`.
StageTimings read_timings_of(const std::filesystem::path& record);

}  // namespace tacipc
