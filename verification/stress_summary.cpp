#include "verification/stress_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/statistics.h"
#include "common/config/config.h"
#include "verification/stage_record.h"

namespace tacipc::verify {
namespace {

constexpr StressOutcome kOutcomes[] = {StressOutcome::converged, StressOutcome::not_converged,
                                       StressOutcome::intersected, StressOutcome::inverted};

StressOutcome outcome_named(const std::string& name) {
  for (const StressOutcome outcome : kOutcomes)
    if (name == name_of(outcome)) return outcome;
  return StressOutcome::not_converged;
}

void add(StressSummary& sum, const StressLine& line) {
  ++sum.cases;
  if (line.crashed) {
    ++sum.crashed;
    return;
  }
  switch (line.result.outcome) {
    case StressOutcome::converged:
      ++sum.converged;
      return;
    case StressOutcome::not_converged:
      ++sum.not_converged;
      return;
    case StressOutcome::intersected:
      ++sum.intersected;
      return;
    case StressOutcome::inverted:
      ++sum.inverted;
      return;
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
  ConfigReader in = ConfigReader::from_file(folder / "stress_case.yaml");
  for (const std::string& key : in.keys())
    if (key != "case" && key != "summary") in.ignore(key);
  ConfigReader drawn = in.section("case");
  line.object = drawn.text("object");
  for (ConfigReader& phase : drawn.sections("motion")) {
    if (!line.motion.empty()) line.motion += ", ";
    line.motion += phase.text("kind");
    for (const std::string& key : phase.keys()) phase.ignore(key);
  }
  for (const std::string& key : drawn.keys()) drawn.ignore(key);
  ConfigReader summary = in.section("summary");
  std::vector<std::string> names;
  for (const StressOutcome outcome : kOutcomes) names.emplace_back(name_of(outcome));
  StressResult& result = line.result;
  result.outcome = outcome_named(summary.choice("outcome", names));
  result.reason = summary.text_or("reason", "");
  result.frames_asked = summary.integer("frames_asked", 0);
  result.frames = summary.integer("frames", 0);
  result.time_steps = summary.integer("time_steps", 0);
  result.newton_iterations = summary.integer("newton_iterations", 0);
  result.moving_iterations = summary.integer("moving_iterations", 0);
  result.lag_iterations = summary.integer("lag_iterations", 0);
  result.min_distance_m = summary.number("min_distance_m");
  result.min_volume_ratio = summary.number("min_volume_ratio");
  result.press_force_n = summary.number("press_force_n");
  in.finish();
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
  int frames = 0, time_steps = 0, newton = 0, moving = 0, lags = 0, finished = 0;
  double volume = std::numeric_limits<double>::infinity();
  std::vector<double> distances;
  for (const StressLine& line : lines) {
    add(all, line);
    add(by_kind[line.crashed ? "(crashed)" : line.object], line);
    if (line.crashed) continue;
    ++finished;
    frames += line.result.frames;
    time_steps += line.result.time_steps;
    newton += line.result.newton_iterations;
    moving += line.result.moving_iterations;
    lags += line.result.lag_iterations;
    distances.push_back(line.result.min_distance_m);
    volume = std::min(volume, line.result.min_volume_ratio);
  }
  const std::string config = fmt::format("configs/studies/stress/{}.yaml", ranges);
  const bool grasps = ranges == "grasp", presses = ranges == kStressRanges;
  const std::string what =
      grasps
          ? "Two random coarse gels close on a random object, lift it, shake it, and in some cases open"
          : "Each case presses a random object into a random coarse gel, up to three quarters of the gel's thickness "
            "deep, then shears, twists, tilts or releases it";
  std::string out = fmt::format(
      "# Stress campaign{0}\n\nMade by `make -f Makefile.data {1} SEED={2} N={3}`. {7}; `{4}` has the ranges. "
      "Seed and index reproduce a case: "
      "`stress_case --config {4} --seed {2} --index 7 --out DIR --log-level debug`. The "
      "campaign holds with no intersection, inversion (exact tests of every frame) or crash, and with less than 1 % of "
      "cases that did not converge. A case counts as converged if every frame passes the [verdict](verdict.md).\n\n"
      "{5}: {6}.\n\n"
      "| object | cases | converged | not converged | intersected | inverted | crashed "
      "|\n|---|---|---|---|---|---|---|\n",
      presses  ? ""
      : grasps ? " of grasps"
               : " of small presses",
      presses  ? "stress"
      : grasps ? "grasp-campaign"
               : "campaign",
      seed, lines.size(), config, all.holds() ? "Holds" : "**Does not hold**", found(all, seed), what);
  for (const auto& [kind, sum] : by_kind) out += row(kind, sum);
  out += row("all", all);
  if (finished > 0) {
    out += fmt::format(
        "\n| total | |\n|---|---|\n| frames | {} |\n| time steps | {} |\n| of these by halving | {} |\n"
        "| Newton iterations | {} |\n| of these moving the object | {} |\n| renewals of friction | {} |\n"
        "| smallest distance | {:.3g} µm |\n| smallest distance of half of the cases | {:.3g} µm |\n"
        "| smallest volume ratio | {:.3g} |\n",
        frames, time_steps, time_steps - frames, newton, moving, lags, 1e6 * lower_quantile(distances, 0.0),
        1e6 * lower_quantile(distances, 0.5), volume);
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
