#include <algorithm>
#include <map>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "stages/study/marker_fit/fit_report.h"

namespace {

using namespace tacipc;

const StageSpec kMarkerFit{
    .name = "marker_fit",
    .summary =
        "Fit depth and travel of a ball to measured marker vectors, and compare the other vectors with simulated ones.",
    .inputs =
        {{"--config", "the benchmark (YAML)"},
         {"--pressed", "vectors measured after the press (CSV: Mx,My,dx,dy in px)"},
         {"--sheared", "vectors measured after the shear (CSV)"},
         InputSpec::several_named(
             "--runs",
             "a press, or a folder with several, by what ran it: first the base, then variants and other simulators")},
    .options = {{.flag = "--name",
                 .help = "what the first row is called (default: the name its runs were given under)",
                 .fallback = ""}}};

/// Presses given under one name.
struct Presses {
  std::string name;
  std::vector<std::filesystem::path> folders;
};

/// Presses by name, in the order in which names first occur.
std::vector<Presses> presses_of(const std::vector<NamedPath>& runs) {
  std::vector<Presses> presses;
  for (const auto& [name, folder] : runs) {
    auto same = std::ranges::find_if(presses, [&](const Presses& p) { return p.name == name; });
    if (same == presses.end()) same = presses.insert(same, {.name = name, .folders = {}});
    same->folders.push_back(folder);
  }
  return presses;
}

template <typename Fit>
FitRow tried_row(const std::string& name, const Fit& fit) {
  try {
    return {.name = name, .fit = fit()};
  } catch (const DataError& error) {
    log_warning("{}: {}", name, error.what());
    return {.name = name, .no_fit = error.what()};
  }
}

FitRow row_of(const std::string& name, const PressedRuns& runs, const MeasuredPressAndShear& measured,
              const MarkerAssumptions& assumed, const MarkerBenchmark& benchmark) {
  return tried_row(name, [&] { return fit_field(runs, measured, assumed, benchmark); });
}

/// Row of another simulator. It may have left no presses. If a depth beyond its simulated ones would fit better, the
/// nearest of them is used, because it may have no other.
FitRow row_of_other(const Presses& presses, const MeasuredPressAndShear& measured, const MarkerBenchmark& benchmark) {
  return tried_row(presses.name, [&] {
    const PressedRuns runs(presses.folders, benchmark.assumed.ball_radius_m);
    return fit_field(runs, measured, benchmark.assumed, benchmark, true);
  });
}

/// Writes both fields, measured and simulated. File names begin with `prefix`, titles with `simulator` if it is not
/// empty.
void write_pictures(Stage& stage, const std::string& prefix, const std::string& simulator, const FieldFit& fit,
                    const MeasuredPressAndShear& measured, const MarkerBenchmark& benchmark) {
  constexpr double kEnlargedPress = 4.0, kEnlargedShear = 2.0;
  const std::string title = simulator.empty() ? "" : simulator + ", ";
  write_file(stage.output(prefix + "press.svg"),
             quiver_svg(measured.press, fit.press_px, benchmark.image_px, kEnlargedPress, title + "press"));
  write_file(stage.output(prefix + "shear.svg"),
             quiver_svg(measured.shear, fit.shear_px, benchmark.image_px, kEnlargedShear, title + "press and shear"));
}

Value::Map values_of(const FieldErrors& e) {
  return {{"vectors", e.markers}, {"mean_px", e.mean_px},     {"median_px", e.median_px},
          {"max_px", e.max_px},   {"angle_deg", e.angle_deg}, {"length_ratio", e.ratio}};
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kMarkerFit, argc, argv, [](Stage& stage) {
    const auto benchmark = stage.read_config<MarkerBenchmark>("--config");
    const MeasuredPressAndShear measured(read_marker_field(stage.input("--pressed")),
                                         read_marker_field(stage.input("--sheared")), benchmark);
    const std::vector<Presses> presses = presses_of(stage.named_inputs("--runs"));
    std::map<std::string, std::vector<std::filesystem::path>> of_variant;
    std::vector<Presses> others;
    for (std::size_t i = 1; i < presses.size(); ++i) {
      const bool variant = std::ranges::any_of(benchmark.variants,
                                               [&](const auto& v) { return v.own_runs && v.name == presses[i].name; });
      if (variant)
        of_variant[presses[i].name] = presses[i].folders;
      else
        others.push_back(presses[i]);
    }
    const std::string& name = stage.option("--name");
    const PressedRuns base(presses.front().folders, benchmark.assumed.ball_radius_m);
    std::vector<FitRow> rows{{.name = name.empty() ? presses.front().name : name,
                              .fit = fit_field(base, measured, benchmark.assumed, benchmark)}};
    for (const Presses& other : others) rows.push_back(row_of_other(other, measured, benchmark));
    for (const MarkerVariant& variant : benchmark.variants) {
      if (variant.own_runs && !of_variant.contains(variant.name)) {
        rows.push_back({.name = variant.name, .no_fit = "not simulated"});
      } else if (variant.own_runs) {
        rows.push_back(row_of(variant.name, PressedRuns(of_variant[variant.name], variant.assumed.ball_radius_m),
                              measured, variant.assumed, benchmark));
      } else {
        rows.push_back(row_of(variant.name, base, measured, variant.assumed, benchmark));
      }
    }
    const FieldFit& fit = *rows.front().fit;
    write_file(stage.output("table.md"), fit_table(rows, measured, benchmark));
    write_file(stage.output("vectors.csv"), vectors_csv(fit, measured));
    write_pictures(stage, "", name, fit, measured, benchmark);
    const std::vector<FitRow> simulators(rows.begin(), rows.begin() + 1 + static_cast<std::ptrdiff_t>(others.size()));
    Value::List of_others;
    for (std::size_t i = 1; i < simulators.size(); ++i) {
      const FitRow& row = simulators[i];
      if (!row.fit) continue;
      write_pictures(stage, row.name + "_", row.name, *row.fit, measured, benchmark);
      of_others.emplace_back(Value::Map{{"name", row.name},
                                        {"depth_mm", 1e3 * row.fit->depth_m},
                                        {"way_mm", 1e3 * row.fit->way_m},
                                        {"press", values_of(row.fit->press)},
                                        {"shear", values_of(row.fit->shear)}});
    }
    if (!others.empty()) write_file(stage.output("others.md"), comparison_text(simulators));
    stage.summarize({{"depth_mm", 1e3 * fit.depth_m},
                     {"way_mm", 1e3 * fit.way_m},
                     {"press", values_of(fit.press)},
                     {"shear", values_of(fit.shear)}});
    if (!of_others.empty()) stage.summarize({{"others", std::move(of_others)}});
  });
}
