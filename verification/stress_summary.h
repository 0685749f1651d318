// Results of a stress campaign: counts, totals, and every case that did not converge.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "verification/stress_case.h"

namespace tacipc::verify {

/// A case as its record describes it. A case without a record crashed.
struct StressLine {
  std::string name;  // name of its folder
  bool crashed = false;
  std::string object, motion;
  StressResult result;
};

/// Reads `stress_case.yaml` in a case's folder; if it is missing, the reason in `stress_case.failed.yaml`.
/// \throw DataError, ConfigError for a file that is not such a record
StressLine read_stress_line(const std::filesystem::path& folder);

/// Counts over all cases.
struct StressSummary {
  int cases = 0, converged = 0, not_converged = 0, intersected = 0, inverted = 0, crashed = 0;

  /// True if there is no intersection, inversion or crash, and fewer than one case in a hundred did not converge.
  bool holds() const { return cases > 0 && intersected + inverted + crashed == 0 && 100 * not_converged < cases; }
};

/// Counts the cases.
StressSummary summarize(const std::vector<StressLine>& lines);

/// The counts as one line of text.
std::string found(const StressSummary& summary, const std::string& seed);

/// Ranges of docs/stress.md. Other ranges belong to the campaign of many small presses.
inline constexpr const char* kStressRanges = "stress";

/// Page of a seed: verdict, counts by kind of object, totals, and the list of cases that did not converge.
/// \param ranges name of the ranges' file in configs/studies/stress
std::string to_markdown(const std::vector<StressLine>& lines, const std::string& seed,
                        const std::string& ranges = kStressRanges);

}  // namespace tacipc::verify
