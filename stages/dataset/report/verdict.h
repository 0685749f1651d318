// What a press was checked against: each check with what was reached and its limit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/sample/press_record.h"

namespace tacipc {

struct FrameReport;

/// How many pairs of triangles may intersect and how many tetrahedra be inverted.
struct CountLimits {
  int intersections = 0;
  int inverted_tets = 0;
};
CountLimits count_limits(const RecordLines<PressSummary>& summary);

struct CheckReport {
  std::string name;
  std::string value;         // what was reached, with its unit
  std::string limit;         // what had to hold, with its unit
  std::optional<int> frame;  // where it came nearest to the limit, if known
  bool held = true;
};

/// The checks a finished press has numbers and limits for, the limits as the summary tells them: press alone defines
/// them. Older records tell none; those of their limits that have always been zero are taken as that. Numbers over all
/// frames are taken from the summary, and once more from the frames where these are worse.
/// \throw DataError if the summary lacks one that every press has.
std::vector<CheckReport> checks_of(const RecordLines<PressSummary>& summary, const std::vector<FrameReport>& frames);

/// The check that ended a press, from the file of its failure. \throw DataError if it is malformed.
struct FailedCheck {
  std::string message;  // empty if none
  std::optional<CheckReport> check;
};
FailedCheck read_failed_check(const Record& failed);

}  // namespace tacipc
