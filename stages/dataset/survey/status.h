// Progress of a dataset.
#pragma once

#include <cstddef>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string>

namespace tacipc {

/// Samples with an index from `first` to before `end`; without `end` up to the last in the table.
struct IndexRange {
  std::size_t first = 0;
  std::optional<std::size_t> end = std::nullopt;
};

/// Numbers of samples and presses by status.
struct DatasetStatus {
  std::size_t samples = 0, made = 0, failed = 0, running = 0;
  std::size_t made_recently = 0;  // samples made in the ten minutes before `now`
  double recent_seconds = 0.0;    // time since the first of these
  /// Presses by members of an ensemble for made samples.
  std::size_t presses = 0, presses_made = 0, presses_failed = 0;

  std::size_t left() const { return samples - made - failed; }
};

/// Progress of a range. Looks only at which records exist, so it may be called while others work.
/// \throw DataError if the plan's table does not have all samples of the range, or none
DatasetStatus dataset_status(const std::filesystem::path& dataset, const IndexRange& range, std::time_t now);

/// Lines of text about the progress.
std::string to_text(const DatasetStatus& status, const std::filesystem::path& dataset);

}  // namespace tacipc
