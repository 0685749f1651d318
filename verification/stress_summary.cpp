#include "verification/stress_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/statistics.h"
#include "common/config/config.h"
#include "tacipc_verification_texts.h"
#include "verification/stage_record.h"

namespace tacipc::verify {
namespace {

void add(StressSummary& sum, const StressLine& line) {
  ++sum.cases;
  if (line.crashed) {
    ++sum.crashed;
    return;
  }
  switch (line.result.outcome) {
    case StressOutcome::converged: ++sum.converged; return;
    case StressOutcome::not_converged: ++sum.not_converged; return;
    case StressOutcome::intersected: ++sum.intersected; return;
    case StressOutcome::inverted: ++sum.inverted; return;
  }
}

std::string row(const std::string& label, const StressSummary& sum) {
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", label, sum.cases, sum.converged, sum.not_converged,
                     sum.intersected, sum.inverted, sum.crashed);
}

}  // namespace

StressLine read_stress_line(const std::filesystem::path& folder) {
  StressLine line;
  line.name = folder.filename().string();
  if (const auto failure = why_no_record(folder, "stress_case")) {
    line.crashed = true;
    line.result.reason = *failure;
    return line;
  }
  const Record record = Record::from_file(folder / "stress_case.yaml"), drawn = record.section("case");
  line.object = drawn.required_text("object");
  for (const Record& phase : drawn.sections("motion"))
    line.motion += (line.motion.empty() ? "" : ", ") + phase.required_text("kind");
  line.result = StressResult::read(record.section("summary"));
  return line;
}

StressSummary summarize(const std::vector<StressLine>& lines) {
  StressSummary sum;
  for (const StressLine& line : lines) add(sum, line);
  return sum;
}

std::string found(const StressSummary& sum, const std::string& seed) {
  return fmt::format("{} of {} cases of seed {} converged, {} did not, {} intersected, {} inverted, {} crashed",
                     sum.converged, sum.cases, seed, sum.not_converged, sum.intersected, sum.inverted, sum.crashed);
}

std::string to_markdown(const std::vector<StressLine>& lines, const std::string& seed, const std::string& ranges) {
  StressSummary all;
  std::map<std::string, StressSummary> by_kind;
  int frames = 0;
  std::size_t summed = 0;
  StressTotals sum;
  std::vector<double> distances;
  for (const StressLine& line : lines) {
    add(all, line);
    add(by_kind[line.crashed ? "(crashed)" : line.object], line);
    if (!line.result.totals) continue;
    const StressTotals& totals = *line.result.totals;
    ++summed;
    frames += line.result.frames;
    sum.time_steps += totals.time_steps;
    sum.planned_steps += totals.planned_steps;
    sum.newton_iterations += totals.newton_iterations;
    sum.moving_iterations += totals.moving_iterations;
    sum.lag_iterations += totals.lag_iterations;
    sum.min_volume_ratio = std::min(sum.min_volume_ratio, totals.min_volume_ratio);
    if (totals.min_distance_m) distances.push_back(*totals.min_distance_m);
  }
  const std::string config = fmt::format("configs/studies/stress/{}.yaml", ranges);
  const bool grasps = ranges == "grasp", presses = ranges == kStressRanges;
  const std::string what =
      grasps
          ? "Two random coarse gels close on a random object, lift it, shake it, and in some cases open"
          : "Each case presses a random object into a random coarse gel, up to three quarters of the gel's thickness "
            "deep, then shears, twists, tilts or releases it";
  std::string out =
      fmt::format(kStressPage,
                  presses  ? ""
                  : grasps ? " of grasps"
                           : " of small presses",
                  presses  ? "stress"
                  : grasps ? "grasp-campaign"
                           : "campaign",
                  seed, lines.size(), config, all.holds() ? "Holds" : "**Does not hold**", found(all, seed), what);
  for (const auto& [kind, counts] : by_kind) out += row(kind, counts);
  out += row("all", all);
  if (!distances.empty()) {
    const bool whole = summed == lines.size();
    out += fmt::format(kStressTotals, whole ? "" : fmt::format(" of {} cases", summed), frames, sum.time_steps,
                       sum.time_steps - sum.planned_steps, sum.newton_iterations, sum.moving_iterations,
                       sum.lag_iterations, 1e6 * lower_quantile(distances, 0.0), 1e6 * lower_quantile(distances, 0.5),
                       sum.min_volume_ratio);
    if (!whole)
      out += fmt::format("\nNot in these totals: {} crashed, {} ended early (only the number of frames is known).\n",
                         all.crashed, lines.size() - summed - static_cast<std::size_t>(all.crashed));
  }
  if (all.converged == all.cases) return out;
  out += "\n| case | object | motion | frames | outcome | reason |\n|---|---|---|---|---|---|\n";
  for (const StressLine& line : lines) {
    if (!line.crashed && line.result.outcome == StressOutcome::converged) continue;
    out += fmt::format("| {} | {} | {} | {} of {} | {} | {} |\n", line.name, line.object, line.motion,
                       line.result.frames, line.result.frames_asked,
                       line.crashed ? "crashed" : name_of(line.result.outcome), line.result.reason);
  }
  return out;
}

}  // namespace tacipc::verify
