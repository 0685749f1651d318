// One case from its YAML to its result.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "verification/judge.h"

namespace tacipc::verify {

/// A case that has been run, or could not be.
struct CaseResult {
  CaseSpec spec;
  TetMesh gel;
  TriangleMesh object;
  std::optional<Simulation> simulation;  // absent: skipped or failed
  std::optional<std::string> skipped;    // why: the shared data are not there
  std::optional<std::string> failed;     // why: the press failed
  Judgement judgement;

  bool pass() const { return simulation && judgement.pass(); }
};

/// Runs a case. Data that are not there at all skip it; a shared folder without the file is a failure.
/// \throw DataError, UsageError for a case that cannot be set up
CaseResult run_case(CaseSpec spec, const std::filesystem::path& shared, const ProgressObserver& observe);

/// The result as a tree: title, source, state, rows.
Value to_value(const CaseResult& result);
/// One line per frame: frame, depth_mm, sideways_mm, turned_deg, then every quantity.
std::string to_csv(const CaseResult& result);
/// Press force over depth, or tangential force or torque over the travel once there is one.
std::string to_svg(const CaseResult& result);

}  // namespace tacipc::verify
