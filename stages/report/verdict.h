// What a press was checked against: each check with what was reached and its limit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stages/report/record.h"

namespace tacipc {

struct FrameReport;

/// Limits of docs/verdict.md that are numbers of their own; the others are zero or stand in the press configuration.
inline constexpr double kMaxBalanceRelative = 1e-3;  // of the contact force
inline constexpr double kMaxPoseErrorM = 1e-9;

struct CheckReport {
  std::string name;
  std::string value;         // what was reached, with its unit
  std::string limit;         // what had to hold, with its unit
  std::optional<int> frame;  // where it came nearest to the limit, if known
  bool held = true;
};

/// The checks a finished press has numbers for. Numbers over all frames are taken from the summary, and once more from
/// the frames where these are worse.
/// \throw DataError if the summary lacks one that every press has.
std::vector<CheckReport> checks_of(const Record& summary, const std::vector<FrameReport>& frames);

/// The check that ended a press, from the file of its failure. \throw DataError if it is malformed.
struct FailedCheck {
  std::string message;  // empty if none
  std::optional<CheckReport> check;
};
FailedCheck read_failed_check(const Record& failed);

}  // namespace tacipc
