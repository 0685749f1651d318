// How far a dataset is.
#pragma once

#include <cstddef>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>

namespace tacipc {

/// Samples with an index from `first` to before `end`; without an end all that the table has.
struct IndexRange {
  std::size_t first = 0;
  std::optional<std::size_t> end = std::nullopt;
};

struct DatasetStatus {
  std::size_t samples = 0, made = 0, failed = 0, running = 0;
  std::size_t made_recently = 0;  // in the ten minutes before `now` …
  double recent_seconds = 0.0;    // … since the first of which so much time has passed
  /// Presses by members of an ensemble beside samples that are made.
  std::size_t presses = 0, presses_made = 0, presses_failed = 0;

  std::size_t left() const { return samples - made - failed; }
};

/// Looks only at which records are there, so it may be asked while others work. \throw DataError if the plan's table
/// does not have all samples of the range, or none
DatasetStatus dataset_status(const std::filesystem::path& dataset, const IndexRange& range, std::time_t now);

/// Lines that say so.
std::string to_text(const DatasetStatus& status, const std::filesystem::path& dataset);

}  // namespace tacipc
