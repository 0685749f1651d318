// Results of a stress campaign: counts, totals, and every case that did not converge.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verification/stress_case.h"

namespace tacipc::verify {

/// A case as its record tells it; without a record it crashed.
struct StressLine {
  std::string name;  // of its folder
  bool crashed = false;
  std::string object, motion;
  StressResult result;
};

/// Reads `stress_case.yaml` in a case's folder; where there is none, the reason of `stress_case.failed.yaml`.
/// \throw DataError, ConfigError for a record that is not one
StressLine read_stress_line(const std::filesystem::path& folder);

struct StressSummary {
  int cases = 0, converged = 0, not_converged = 0, intersected = 0, inverted = 0, crashed = 0;

  /// No intersection, inversion or crash, and fewer than one case in a hundred that did not converge.
  bool holds() const { return cases > 0 && intersected + inverted + crashed == 0 && 100 * not_converged < cases; }
};

StressSummary summarize(const std::vector<StressLine>& lines);

/// The counts in one line.
std::string found(const StressSummary& summary, const std::string& seed);

/// The ranges that docs/stress.md is made of; others are of the campaign of many small presses.
inline constexpr const char* kStressRanges = "stress";

/// The page of a seed: verdict, counts by kind of object, totals, the list of cases that did not converge. `ranges` is
/// the name of their file in configs/studies/stress.
std::string to_markdown(const std::vector<StressLine>& lines, const std::string& seed,
                        const std::string& ranges = kStressRanges);

}  // namespace tacipc::verify
