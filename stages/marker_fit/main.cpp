#include <map>

#include "common/error.h"
#include "common/files.h"
#include "common/log.h"
#include "common/stage.h"
#include "stages/marker_fit/fit_report.h"
#include "stages/marker_fit/quiver.h"

namespace {

using namespace tacipc;

const StageSpec kMarkerFit{
    .name = "marker_fit",
    .summary = "Fit depth and way of a ball to measured marker vectors, and compare all others with simulated ones.",
    .inputs = {
        {.flag = "--config", .help = "the benchmark (YAML)"},
        {.flag = "--pressed", .help = "vectors measured after the press (CSV: Mx,My,dx,dy in px)"},
        {.flag = "--sheared", .help = "vectors measured after the shear (CSV)"},
        {.flag = "--runs",
         .help = "folder of presses to several depths: first the base, then variants and other simulators, each by its "
                 "folder's name",
         .many = true}}};

std::string name_of(const std::filesystem::path& folder) {
  const auto path = folder.lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

FitRow row_of(const std::string& name, const PressedRuns& runs, const MeasuredPressAndShear& measured,
              const MarkerAssumptions& assumed, const MarkerBenchmark& benchmark) {
  try {
    return {.name = name, .fit = fit_field(runs, measured, assumed, benchmark)};
  } catch (const DataError& error) {
    log_warning("{}: {}", name, error.what());
    return {.name = name, .no_fit = error.what()};
  }
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
    const auto& folders = stage.inputs("--runs");
    std::map<std::string, std::filesystem::path> of_variant;
    std::vector<std::filesystem::path> others;
    for (std::size_t i = 1; i < folders.size(); ++i) {
      bool variant = false;
      for (const MarkerVariant& v : benchmark.variants)
        variant = variant || (v.own_runs && v.name == name_of(folders[i]));
      if (variant)
        of_variant[name_of(folders[i])] = folders[i];
      else
        others.push_back(folders[i]);
    }
    const PressedRuns base(folders.front(), benchmark.assumed.ball_radius_m);
    std::vector<FitRow> rows{
        {.name = name_of(folders.front()), .fit = fit_field(base, measured, benchmark.assumed, benchmark)}};
    for (const auto& folder : others)
      rows.push_back(row_of(name_of(folder), PressedRuns(folder, benchmark.assumed.ball_radius_m), measured,
                            benchmark.assumed, benchmark));
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
    constexpr double kEnlargedPress = 4.0, kEnlargedShear = 2.0;
    write_file(stage.output("press.svg"),
               quiver_svg(measured.press, fit.press_px, benchmark.image_px, kEnlargedPress, "press"));
    write_file(stage.output("shear.svg"),
               quiver_svg(measured.shear, fit.shear_px, benchmark.image_px, kEnlargedShear, "press and shear"));
    stage.summarize({{"depth_mm", 1e3 * fit.depth_m},
                     {"way_mm", 1e3 * fit.way_m},
                     {"press", values_of(fit.press)},
                     {"shear", values_of(fit.shear)}});
  });
}
