// Checks of a press: each with its value and its limit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/sample/press_record.h"

namespace tacipc {

struct FrameReport;

/// Permitted numbers of intersecting pairs of triangles and of inverted tetrahedra.
struct CountLimits {
  int intersections = 0;
  int inverted_tets = 0;
};
CountLimits count_limits(const RecordLines<PressSummary>& summary);

/// One check of a press.
struct CheckReport {
  std::string name;
  std::string value;         // value with its unit
  std::string limit;         // limit with its unit
  std::optional<int> frame;  // frame nearest to the limit, if known
  bool held = true;
};

/// Checks for which a finished press has numbers and limits. The limits come from the summary, because only press
/// defines them. Older records have none; limits that have always been zero then count as zero. Numbers over all frames
/// come from the summary, or from the frames if these are worse.
/// \throw DataError if the summary lacks a limit that every press has
std::vector<CheckReport> checks_of(const RecordLines<PressSummary>& summary, const std::vector<FrameReport>& frames);

/// Check that ended a press, from its failure file.
/// \throw DataError if the file is malformed
struct FailedCheck {
  std::string message;  // empty: no message
  std::optional<CheckReport> check;
};
FailedCheck read_failed_check(const Record& failed);

}  // namespace tacipc
