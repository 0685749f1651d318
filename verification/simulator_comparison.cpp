#include "verification/simulator_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/image/plot.h"
#include "tacipc_verification_long_texts.h"
#include "verification/stage_record.h"

namespace tacipc::verify {
namespace {

using Settings = std::vector<std::pair<std::string, std::string>>;

/// Collects every value of a record's configuration by its path.
void flatten(const Value& value, const std::string& path, Settings& out) {
  if (const auto* map = std::get_if<Value::Map>(&value.data())) {
    for (const auto& [key, inner] : *map) flatten(inner, path.empty() ? key : path + "." + key, out);
  } else if (const auto* text = std::get_if<std::string>(&value.data())) {
    out.emplace_back(path, *text);
  } else {
    out.emplace_back(path, to_yaml(Value(Value::Map{{"list", value}})).substr(sizeof("list: ") - 1));
    while (!out.back().second.empty() && out.back().second.back() == '\n') out.back().second.pop_back();
  }
}

std::optional<std::string> value_at(const Settings& settings, const std::string& path) {
  for (const auto& [key, value] : settings)
    if (key == path) return value;
  return std::nullopt;
}

/// Differing settings: path, value here, value there; "not said" for a missing value.
std::vector<std::array<std::string, 3>> differences(const Settings& here, const Settings& there) {
  std::vector<std::array<std::string, 3>> out;
  for (const auto& [path, value] : here)
    if (const auto other = value_at(there, path); other != value)
      out.push_back({path, value, other.value_or("not said")});
  for (const auto& [path, value] : there)
    if (!value_at(here, path)) out.push_back({path, "not said", value});
  return out;
}

/// Displacements of a run's chosen markers in its last frame.
struct Ending {
  double mean_m = 0.0;
  double of_way = 0.0;  // fraction of the displacement of markers that stick to the object
  double all_m = 0.0;   // mean of all markers, chosen or not
};

Ending ending(const SimulatorRun& run, const MarkerChoice& chosen) {
  const double mean_m = mean_displacements(*run.motion, chosen).back();
  return {mean_m, mean_m / mean_of_carried(*run.motion, chosen).back(),
          run.motion->markers.back().colwise().norm().mean()};
}

std::string way_text(const MarkerMotion& motion, double way, const char* by = "by") {
  return motion.turns ? fmt::format("turned {} {:.3g}°", by, way / kDegree)
                      : fmt::format("dragged {} {:.3g} mm", by, way / kMillimetre);
}

std::string row_of(const ComparedRuns& all, std::size_t s, std::size_t m) {
  const SimulatorRun& run = all.at(s, m);
  const SimulatorRun& ours = all.at(0, m);
  const std::string& label = all.config.simulators[s].label;
  if (!run.motion) return fmt::format("| {} | **failed**: {} | | | | | | |\n", label, run.failure);
  const Ending end = ending(run, all.config.chosen);
  std::string beside = "| | |";
  if (s > 0 && ours.motion) {
    const MotionComparison c = compare(*ours.motion, *run.motion, all.config.chosen);
    beside = fmt::format("| {:.2f} | {:.0f} | {:.0f}", c.ratio, c.error_m / kMicrometre, c.largest_m / kMicrometre);
  }
  return fmt::format("| {} | {:.1f} | {:.0f} % {} | {:.1f} | {} |\n", label, end.mean_m / kMicrometre,
                     100.0 * end.of_way, beside, end.all_m / kMicrometre,
                     run.half_speed_change ? fmt::format("{:.2f} %", 100.0 * *run.half_speed_change) : "");
}

/// Travel up to which the other's mean stays below `ours`, if that ends after the first and before the last frame.
std::optional<double> shorter_up_to(const MarkerMotion& ours, const MarkerMotion& other, const MarkerChoice& chosen) {
  const std::vector<double> own = mean_displacements(ours, chosen), their = mean_displacements(other, chosen);
  std::size_t f = 1;
  while (f < own.size() && f < their.size() && their[f] < own[f] * other.way[f] / ours.way[f]) ++f;
  if (f == 1 || f >= std::min(own.size(), their.size())) return std::nullopt;
  return ours.way[f - 1];
}

/// Sentence that compares the others' final marker displacements with the first one's, and states whether the paper's
/// finding is reproduced.
std::string finding(const ComparedRuns& all, std::size_t m) {
  const SimulatorRun& ours = all.at(0, m);
  if (!ours.motion) return "";
  const Ending own = ending(ours, all.config.chosen);
  std::string out = fmt::format(
      "The object is {}. {}: the markers around its middle move by {:.0f} µm, {:.0f} % of the object's travel over "
      "them.",
      way_text(*ours.motion, ours.motion->way.back()), all.config.simulators[0].label, own.mean_m / kMicrometre,
      100.0 * own.of_way);
  for (std::size_t s = 1; s < all.config.simulators.size(); ++s) {
    const SimulatorRun& run = all.at(s, m);
    if (!run.motion) continue;
    const double ratio = ending(run, all.config.chosen).mean_m / own.mean_m;
    out += fmt::format(" {}: {:.2f} times that", all.config.simulators[s].label, ratio);
    if (run.stage != ours.stage)
      out += ratio < all.config.reported_below         ? ", shorter, as the paper reports"
             : ratio > 1.0 / all.config.reported_below ? ", longer; the paper reports clearly shorter ones"
                                                       : ", about as long; the paper reports clearly shorter ones";
    if (const auto way = shorter_up_to(*ours.motion, *run.motion, all.config.chosen); way && run.stage != ours.stage)
      out += fmt::format(" (shorter while the object is {})", way_text(*ours.motion, *way, "up to"));
    out += ".";
  }
  return out;
}

/// Runs of every simulator under the first motion, to which factors belong.
std::vector<const SimulatorRun*> first_motion(const ComparedRuns& all) {
  std::vector<const SimulatorRun*> runs;
  for (std::size_t s = 0; s < all.config.simulators.size(); ++s) runs.push_back(&all.at(s, 0));
  return runs;
}

/// \pre a run of the first motion
const std::string& label_of(const ComparedRuns& all, const SimulatorRun& run) {
  const std::vector<const SimulatorRun*> runs = first_motion(all);
  return all.config.simulators[std::ranges::find(runs, &run) - runs.begin()].label;
}

std::string factor_rows(const ComparedRuns& all) {
  const SimulatorRun& ours = all.at(0, 0);
  std::string out;
  const std::vector<const SimulatorRun*> bases = first_motion(all);
  for (const SimulatorRun& run : all.factors) {
    const SimulatorRun* base = nearest_run(run, bases);
    if (!run.motion || !base) {
      out += fmt::format("| {} | | **failed**: {} | | | |\n", run.name, run.failure);
      continue;
    }
    const Ending end = ending(run, all.config.chosen);
    out += fmt::format("| {} | {} | {:.1f} | {:.0f} % | {:.2f} | {} |\n", label_of(all, *base),
                       differing_settings(run, *base), end.mean_m / kMicrometre, 100.0 * end.of_way,
                       end.mean_m / ending(*base, all.config.chosen).mean_m,
                       ours.motion ? fmt::format("{:.2f}", end.mean_m / ending(ours, all.config.chosen).mean_m) : "");
  }
  return out;
}

/// Sentence on the changed parameters that give the shortest and the longest vectors, for each stage that was varied.
std::string factor_finding(const ComparedRuns& all) {
  const SimulatorRun& ours = all.at(0, 0);
  const std::vector<const SimulatorRun*> bases = first_motion(all);
  const auto mean = [&](const SimulatorRun& run) { return ending(run, all.config.chosen).mean_m; };
  const auto said = [&](const SimulatorRun& run) {
    std::string out =
        fmt::format("{}: {:.0f} µm", differing_settings(run, *nearest_run(run, bases)), mean(run) / kMicrometre);
    if (ours.motion) out += fmt::format(", {:.2f} times those of {}", mean(run) / mean(ours), label_of(all, ours));
    return out;
  };
  std::string out;
  for (const SimulatorRun* base : bases) {
    const SimulatorRun *shortest = nullptr, *longest = nullptr;
    for (const SimulatorRun& run : all.factors) {
      if (!run.motion || nearest_run(run, bases) != base) continue;
      if (!shortest || mean(run) < mean(*shortest)) shortest = &run;
      if (!longest || mean(run) > mean(*longest)) longest = &run;
    }
    if (!shortest) continue;
    out += fmt::format("{}, one value changed: ", label_of(all, *base));
    out += shortest == longest
               ? fmt::format("with {}.\n", said(*shortest))
               : fmt::format("shortest vectors with {}; longest with {}.\n", said(*shortest), said(*longest));
  }
  return out;
}

}  // namespace

SimulatorComparison SimulatorComparison::read(ConfigReader& in) {
  SimulatorComparison config;
  config.title = in.text("title");
  config.chosen = MarkerChoice::read(in);
  config.motions = in.texts("motions");
  if (config.motions.empty()) in.fault("motions", "name at least one");
  for (ConfigReader& simulator : in.sections("simulators"))
    config.simulators.push_back({.name = simulator.text("name"), .label = simulator.text("label")});
  if (config.simulators.size() < 2) in.fault("simulators", "name at least two");
  config.reported_below = in.number("reported_below", Range::positive());
  return config;
}

SimulatorRun SimulatorRun::read(const std::filesystem::path& folder) {
  SimulatorRun run;
  run.name = folder.lexically_normal().filename().string();
  for (const char* stage : {"press", "mpm"}) {
    const auto failure = why_no_record(folder, stage);
    const bool failed = failure && std::filesystem::exists(folder / (std::string(stage) + ".failed.yaml"));
    if (failed) run.failure = *failure;
    if (failure) continue;
    ConfigReader record = ConfigReader::from_file(folder / (std::string(stage) + ".yaml"));
    run.stage = stage;
    run.name = record.text("name");
    flatten(record.section("config").section("config").content(), "", run.settings);
    ConfigReader summary = record.section("summary");
    run.half_speed_change = summary.optional_number("marker_change_at_half_speed");
    run.motion = read_other_motion(folder);
    run.motion->name = run.name;
    run.failure.clear();
    return run;
  }
  if (run.failure.empty()) run.failure = "left no record";
  return run;
}

std::string differing_settings(const SimulatorRun& run, const SimulatorRun& from) {
  std::string out;
  for (const auto& [path, value, other] : differences(run.settings, from.settings))
    out += fmt::format("{}`{}` {} ({})", out.empty() ? "" : ", ", path, value, other);
  return out;
}

const SimulatorRun* nearest_run(const SimulatorRun& run, const std::vector<const SimulatorRun*>& others) {
  const SimulatorRun* nearest = nullptr;
  std::size_t fewest = 0;
  for (const SimulatorRun* other : others) {
    if (other->stage != run.stage || !other->motion) continue;
    const std::size_t count = differences(run.settings, other->settings).size();
    if (nearest && count >= fewest) continue;
    nearest = other;
    fewest = count;
  }
  return nearest;
}

std::string comparison_curve_svg(const ComparedRuns& all, std::size_t m) {
  Plot plot{.title = all.config.title + ": " + all.config.motions[m],
            .x_label = "",
            .y_label = "mean displacement of the markers (um)"};
  PlotCurve stuck{.label = "stuck to the object"};
  for (std::size_t s = 0; s < all.config.simulators.size(); ++s) {
    const SimulatorRun& run = all.at(s, m);
    if (!run.motion) continue;
    const MarkerMotion& motion = *run.motion;
    plot.x_label = motion.turns ? "turn (degrees)" : "travel of the object (mm)";
    const auto points = [&](const std::vector<double>& mean_m) {
      std::vector<Eigen::Vector2d> out;
      for (std::size_t f = 0; f < mean_m.size(); ++f)
        out.emplace_back(motion.way[f] / (motion.turns ? kDegree : kMillimetre), mean_m[f] / kMicrometre);
      return out;
    };
    plot.curves.push_back(
        {.label = all.config.simulators[s].label, .points = points(mean_displacements(motion, all.config.chosen))});
    if (stuck.points.empty()) stuck.points = points(mean_of_carried(motion, all.config.chosen));
  }
  plot.curves.push_back(stuck);
  return to_svg(plot);
}

std::string comparison_curve_csv(const ComparedRuns& all, std::size_t m) {
  std::string out = "simulator,frame,way_mm_or_deg,mean_displacement_um,stuck_to_object_um\n";
  for (std::size_t s = 0; s < all.config.simulators.size(); ++s) {
    const SimulatorRun& run = all.at(s, m);
    if (!run.motion) continue;
    const MarkerMotion& motion = *run.motion;
    const auto mean = mean_displacements(motion, all.config.chosen), stuck = mean_of_carried(motion, all.config.chosen);
    for (std::size_t f = 0; f < mean.size(); ++f)
      out += fmt::format(
          "{},{},{:.9g},{:.9g},{:.9g}\n", all.config.simulators[s].name, motion.press_end_frame + static_cast<int>(f),
          motion.way[f] / (motion.turns ? kDegree : kMillimetre), mean[f] / kMicrometre, stuck[f] / kMicrometre);
  }
  return out;
}

std::string comparison_page(const ComparedRuns& all, const std::string& pictures) {
  const SimulatorComparison& config = all.config;
  std::string out = fmt::format(kComparisonPage, config.chosen.first_row, config.chosen.last_row,
                                config.chosen.first_column, config.chosen.last_column);
  for (std::size_t m = 0; m < config.motions.size(); ++m) {
    std::string rows, labels, rule, arrows;
    for (std::size_t s = 0; s < config.simulators.size(); ++s) {
      const auto& [name, label] = config.simulators[s];
      rows += row_of(all, s, m);
      if (!all.at(s, m).motion) continue;
      labels += fmt::format(" {} |", label);
      rule += "---|";
      arrows += fmt::format(" ![{0}]({1}/{2}_{3}_{0}.svg) |", name, pictures, config.title, config.motions[m]);
    }
    out += fmt::format(kComparedMotion, config.title, config.motions[m], config.simulators[0].label, rows,
                       finding(all, m), pictures, labels, rule, arrows);
  }
  if (all.factors.empty()) return out;
  return out +
         fmt::format(kFactors, config.motions[0], label_of(all, all.at(0, 0)), factor_rows(all), factor_finding(all));
}

}  // namespace tacipc::verify
