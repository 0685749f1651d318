// Runs one verification case from its YAML file to its result.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "verification/judge.h"

namespace tacipc::verify {

/// A case that was run, skipped or failed.
struct CaseResult {
  CaseSpec spec;
  TetMesh gel;
  TriangleMesh object;
  std::optional<Simulation> simulation;  // absent if the case was skipped or failed
  std::optional<std::string> skipped;    // reason for skipping: the shared data are missing
  std::optional<std::string> failed;     // reason for failing: the error of the press
  Judgement judgement;

  bool pass() const { return simulation && judgement.pass(); }
};

/// Runs a case. The case is skipped if the shared folder does not exist; a missing file in an existing folder is an
/// error.
/// \throw DataError, UsageError for a case that cannot be set up
CaseResult run_case(CaseSpec spec, const std::filesystem::path& shared, const ProgressObserver& observe);

/// Result as a tree: title, source, state, rows.
Value to_value(const CaseResult& result);
/// CSV with one line per frame: frame, depth_mm, sideways_mm, turned_deg, then every quantity.
std::string to_csv(const CaseResult& result);
/// Plot of the press force over depth or, if the object travels sideways, of the tangential force or torque over
/// travel.
std::string to_svg(const CaseResult& result);

}  // namespace tacipc::verify
