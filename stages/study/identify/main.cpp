#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "stages/study/identify/fitted_sensor.h"
#include "stages/study/identify/identify_report.h"
#include "stages/study/identify/runs.h"

namespace {

using namespace tacipc;

const StageSpec kIdentify{
    .name = "identify",
    .summary = "Fit a sensor's mechanics to measured forces and marker vectors, and predict what was not fitted.",
    .inputs = {{"--config", "what is known, measured and simulated (YAML)"},
               {"--sensor", "the sensor file that the presses were run with, but for their nodes (YAML)"},
               InputSpec::several_named("--measured", "the table or folder of a measurement, by its name"),
               InputSpec::several_named("--runs", "a press folder, by NODE/RUN of cases.mk; of a check CHECK/RUN")}};

std::map<std::string, std::filesystem::path> by_name(const std::vector<NamedPath>& named) {
  std::map<std::string, std::filesystem::path> out;
  for (const auto& [name, path] : named) out.insert_or_assign(name, path);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kIdentify, argc, argv, [](Stage& stage) {
    const auto spec = stage.read_config<IdentifySpec>("--config");
    const std::filesystem::path& sensor_file = stage.input("--sensor");
    const auto sensor = read_config<Sensor>(sensor_file);
    const auto measured = by_name(stage.named_inputs("--measured"));
    const auto runs = by_name(stage.named_inputs("--runs"));
    for (const Measurement& m : spec.measurements)
      if (!measured.contains(m.name)) throw UsageError(fmt::format("--measured: {} is missing", m.name));
    const auto folder = [&](const std::string& node, const std::string& run) {
      const auto found = runs.find(node + "/" + run);
      if (found == runs.end()) throw UsageError(fmt::format("--runs: {}/{} is missing", node, run));
      return found->second;
    };
    const double modulus_pa = sensor.material.youngs_modulus_pa;
    MechanicsModel model(spec, read_measurements(spec, folder, measured, modulus_pa), sensor);
    log_info("{} unknowns, {} measured rows", model.unknowns().size(), model.rows());
    const Fit fit = fit_mechanics(model);
    const Posterior posterior = draw_posterior(model, fit, spec.draws, spec.seed);
    constexpr double kFewDraws = 100.0;
    if (posterior.effective_draws < kFewDraws)
      log_warning("of {} draws only {:.0f} count: deviations and intervals are rough; say more draws", spec.draws,
                  posterior.effective_draws);
    std::vector<CheckedPress> checks;
    for (const ModelCheck& check : spec.checks)
      for (std::size_t m = 0; m < spec.measurements.size(); ++m) {
        const Measurement& measurement = spec.measurements[m];
        if (measurement.kind != MeasurementKind::press) continue;
        const std::string run = run_name(measurement, measurement.depths_mm.back());
        checks.push_back({.check = check.name,
                          .measurement = m,
                          .table = read_press_table({folder(spec.middle().name, run), folder(check.name, run)},
                                                    modulus_pa, measurement.depths_mm.back())});
      }
    const IdentifyResult result{.model = model,
                                .fit = fit,
                                .posterior = posterior,
                                .u = posterior.mean_u(),
                                .estimates = estimates_of(model, fit, posterior),
                                .forces = predict_forces(model, posterior, checks),
                                .modulus_error = modulus_error(checks, model),
                                .markers = all_marker_errors(model, posterior)};
    constexpr double kTooFar = 2.0;
    for (std::size_t m = 0; m < spec.measurements.size(); ++m)
      if (const double off = misfit(model, m, result.u); off > kTooFar)
        log_warning(
            "{}: the model is {:.1f} deviations off: something is missing in it, or the deviations are too small",
            spec.measurements[m].name, off);
    for (const Estimate& e : result.estimates)
      log_info("{}{}: {:.6g} ± {:.2g} ({})", e.name, e.measurement.empty() ? "" : " of " + e.measurement, e.value,
               e.sigma, e.told ? "told by measurements" : "by its prior");
    write_file(stage.output("table.md"), result_table(result));
    for (const auto& [name, svg] : result_plots(result)) write_file(stage.output(name), svg);
    constexpr int kProfilePoints = 9;
    for (Eigen::Index i = 0; i < model.unknowns().size(); ++i) {
      const Unknown& unknown = model.unknowns()[i];
      if (!unknown.measurement.empty()) continue;
      write_file(stage.output("profile_" + unknown.name + ".svg"),
                 profile_plot(unknown, fit, i, profile(model, fit, i, kProfilePoints)));
    }
    write_file(stage.output("sensor.yaml"), fitted_sensor(read_file(sensor_file), sensor_file.string(), result));
    write_file(stage.output(kEnsembleFile),
               ensemble_of(result, stage.out() / "sensor.yaml", spec.members).yaml(stage.out()));
    stage.summarize(result_summary(result));
  });
}
