#include "stages/study/identify/identify_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/image/plot.h"

namespace tacipc {
namespace {

/// Value rounded to three digits of its standard deviation.
std::string rounded(double value, double sigma) {
  if (!(sigma > 0.0)) return fmt::format("{:.6g}", value);
  const int digits = std::clamp(static_cast<int>(std::floor(std::log10(std::abs(value) / sigma + 1e-30))) + 3, 2, 8);
  return fmt::format("{:.{}g}", value, digits);
}

}  // namespace

std::string deviation_text(double sigma) { return fmt::format("{:.2g}", sigma); }

std::vector<Estimate> estimates_of(const MechanicsModel& model, const Fit& fit, const Posterior& posterior) {
  std::vector<Estimate> out;
  const Eigen::VectorXd mean = posterior.mean_u();
  for (Eigen::Index i = 0; i < model.unknowns().size(); ++i) {
    const Unknown& unknown = model.unknowns()[i];
    const Eigen::VectorXd u = posterior.u.row(i).transpose();
    Eigen::VectorXd values(u.size());
    for (Eigen::Index k = 0; k < u.size(); ++k) values[k] = unknown.value_of(u[k]);
    const double near = 1e-3 * unknown.prior.sigma;
    out.push_back({.name = unknown.name,
                   .measurement = unknown.measurement,
                   .value = unknown.value_of(mean[i]),
                   .sigma = posterior.deviation(values),
                   .low = posterior.quantile(values, 0.025),
                   .high = posterior.quantile(values, 0.975),
                   .prior = unknown.prior,
                   .told = told_by_measurements(unknown, posterior.deviation(u)),
                   .at_bound = fit.u[i] - unknown.u_low() < near || unknown.u_high() - fit.u[i] < near,
                   .against_prior = std::abs(mean[i] - unknown.u_mean()) >= 3.0 * unknown.prior.sigma});
  }
  return out;
}

double misfit(const MechanicsModel& model, std::size_t measurement, const Eigen::VectorXd& u) {
  const Eigen::VectorXd off = model.off(measurement, u);
  return std::sqrt(off.squaredNorm() / static_cast<double>(off.size()));
}

std::string result_table(const IdentifyResult& result) {
  const IdentifySpec& spec = result.model.spec();
  std::string out = fmt::format("| {} | value | ± | 95 % | prior | told by |\n|---|---|---|---|---|---|\n", spec.title);
  for (const Estimate& e : result.estimates) {
    const std::string prior = e.prior.logarithmic
                                  ? fmt::format("{:.4g}, factor {:.3g}", e.prior.mean, std::exp(e.prior.sigma))
                                  : fmt::format("{:.4g} ± {:.3g}", e.prior.mean, e.prior.sigma);
    out += fmt::format("| {}{} | {}{} | {} | {} … {} | {} | {} |\n", e.name,
                       e.measurement.empty() ? "" : " of " + e.measurement, rounded(e.value, e.sigma),
                       e.at_bound ? " (at its bound)" : "", deviation_text(e.sigma), rounded(e.low, e.sigma),
                       rounded(e.high, e.sigma), prior,
                       !e.told           ? "prior"
                       : e.against_prior ? "measurements, against the prior"
                                         : "measurements");
  }
  out += "\n| measurement | fitted rows | misfit / stated deviation | deviation taken |\n|---|---|---|---|\n";
  for (std::size_t m = 0; m < spec.measurements.size(); ++m) {
    const double factor = result.model.sigma_factor[m], off = misfit(result.model, m, result.u);
    out += fmt::format("| {} | {} | {:.2f} | {} |\n", spec.measurements[m].name, result.model.measured(m).size(),
                       off * factor, factor > 1.0 ? fmt::format("{:.2f} times the stated", factor) : "as stated");
  }
  if (!result.modulus_error.empty()) {
    out += "\nThe model's own error of a modulus:";
    for (const auto& [name, change] : result.modulus_error) out += fmt::format(" {} {:+.1f} %;", name, -100.0 * change);
    out.back() = '.';
    out += '\n';
  }
  if (!result.forces.empty()) {
    out +=
        "\n| press | depth, mm | force, N | ± parameters | ± model | 95 % of measurements | measured, N | off | |\n"
        "|---|---|---|---|---|---|---|---|---|\n";
    for (const ForcePrediction& p : result.forces) {
      const std::string off =
          p.measured_n ? fmt::format("{:.3f} | {:+.1f} %", *p.measured_n, 100.0 * (p.force_n / *p.measured_n - 1.0))
                       : " | ";
      const char* judged = p.fitted        ? "fitted"
                           : !p.measured_n ? "predicted"
                           : p.covered()   ? "predicted: inside"
                                           : "predicted: outside";
      out += fmt::format("| {} | {:g} | {:.3f} | {:.3f} | {:.3f} | {:.3f} … {:.3f} | {} | {} |\n", p.measurement,
                         p.depth_mm, p.force_n, p.parameter_sigma, p.model_sigma, p.low_n, p.high_n, off, judged);
    }
  }
  for (std::size_t m = 0; m < spec.measurements.size(); ++m) {
    if (!spec.measurements[m].markers) continue;
    out += fmt::format(
        "\n| {} | vectors | | mean length, px | mean error, px | coordinates in their 95 % "
        "|\n|---|---|---|---|---|---|\n",
        spec.measurements[m].name);
    for (const MarkerErrors& e : result.markers.at(m))
      out += fmt::format("| {} | {} | {} | {:.2f} | {:.2f} | {:.0f} % |\n", e.photograph, e.vectors,
                         e.fitted ? "fitted" : "predicted", e.measured_px, e.error_px, 100.0 * e.inside);
  }
  return out;
}

Value::Map result_summary(const IdentifyResult& result) {
  Value::List unknowns, forces, errors;
  for (const Estimate& e : result.estimates) {
    Value::Map line{{"name", e.name}};
    if (!e.measurement.empty()) line.emplace_back("of", e.measurement);
    line.insert(line.end(), {{"value", e.value},
                             {"sigma", e.sigma},
                             {"interval_95", std::vector<double>{e.low, e.high}},
                             {"prior_mean", e.prior.mean},
                             {e.prior.logarithmic ? "prior_factor" : "prior_sigma",
                              e.prior.logarithmic ? std::exp(e.prior.sigma) : e.prior.sigma},
                             {"told_by", e.told ? "measurements" : "prior"}});
    if (e.at_bound) line.emplace_back("at_bound", true);
    if (e.against_prior) line.emplace_back("against_prior", true);
    unknowns.emplace_back(std::move(line));
  }
  for (const ForcePrediction& p : result.forces) {
    Value::Map line{{"press", p.measurement},
                    {"depth_mm", p.depth_mm},
                    {"force_n", p.force_n},
                    {"parameter_sigma_n", p.parameter_sigma},
                    {"model_sigma_n", p.model_sigma},
                    {"interval_95_n", std::vector<double>{p.low_n, p.high_n}},
                    {"fitted", p.fitted}};
    if (p.measured_n) {
      line.emplace_back("measured_n", *p.measured_n);
      line.emplace_back("inside", p.covered());
    }
    forces.emplace_back(std::move(line));
  }
  const MechanicsModel& model = result.model;
  for (std::size_t m = 0; m < model.spec().measurements.size(); ++m) {
    const Eigen::VectorXd off = model.predicted(m, result.u) - model.measured(m);
    Value::Map line{{"measurement", model.spec().measurements[m].name},
                    {"rows", static_cast<std::size_t>(off.size())},
                    {"rms", std::sqrt(off.squaredNorm() / static_cast<double>(off.size()))},
                    {"sigma_factor", model.sigma_factor[m]}};
    if (model.spec().measurements[m].markers) {
      Value::List fields;
      for (const MarkerErrors& e : result.markers.at(m))
        fields.emplace_back(Value::Map{{"photograph", e.photograph},
                                       {"fitted", e.fitted},
                                       {"vectors", e.vectors},
                                       {"measured_mean_px", e.measured_px},
                                       {"error_mean_px", e.error_px},
                                       {"inside_95", e.inside}});
      line.emplace_back("fields", std::move(fields));
    }
    errors.emplace_back(std::move(line));
  }
  Value::List covariance;
  for (Eigen::Index i = 0; i < result.fit.covariance.rows(); ++i)
    covariance.emplace_back(
        std::vector<double>(result.fit.covariance.row(i).begin(), result.fit.covariance.row(i).end()));
  Value::Map out{{"unknowns", std::move(unknowns)}, {"measurements", std::move(errors)}};
  if (!forces.empty()) out.emplace_back("forces", std::move(forces));
  if (!result.modulus_error.empty()) {
    Value::Map by_check;
    for (const auto& [name, change] : result.modulus_error) by_check.emplace_back(name, -change);
    out.emplace_back("modulus_error", std::move(by_check));
  }
  out.emplace_back("effective_draws", result.posterior.effective_draws);
  out.emplace_back("covariance", std::move(covariance));
  return out;
}

std::map<std::string, std::string> result_plots(const IdentifyResult& result) {
  std::map<std::string, std::string> files;
  const MechanicsModel& model = result.model;
  for (std::size_t m = 0; m < model.spec().measurements.size(); ++m) {
    const Measurement& measurement = model.spec().measurements[m];
    if (measurement.markers) {
      constexpr double kEnlargedPress = 4.0, kEnlargedShear = 2.0;
      const auto [press, shear] = model.marker_px(m, result.u);
      const MarkerData& data = *model.data(m).markers;
      const Eigen::Vector2d image(model.camera_px());
      files[measurement.name + "_press.svg"] =
          quiver_svg(data.press, press, image, kEnlargedPress, measurement.name + ", press");
      files[measurement.name + "_shear.svg"] =
          quiver_svg(data.shear, shear, image, kEnlargedShear, measurement.name + ", press and shear");
      continue;
    }
    const bool press = measurement.kind == MeasurementKind::press;
    const char* x_label = press ? "depth, mm" : measurement.kind == MeasurementKind::shear ? "travel, mm" : "time, s";
    Plot curve{.title = measurement.name, .x_label = x_label, .y_label = "force, N"};
    Plot residual{.title = measurement.name, .x_label = x_label, .y_label = "predicted - measured, N"};
    PlotCurve seen{.label = "measured, fitted", .dots = true}, rest{.label = "measured, not fitted", .dots = true};
    PlotCurve off{.label = "fitted", .dots = true}, off_rest{.label = "not fitted", .dots = true};
    const ForceData& data = *model.data(m).force;
    const Eigen::VectorXd predicted = model.predicted(m, result.u);
    for (std::size_t i = 0; i < data.fitted.size(); ++i) {
      seen.points.emplace_back(data.fitted[i].at, data.fitted[i].force_n);
      off.points.emplace_back(data.fitted[i].at, predicted[i] - data.fitted[i].force_n);
    }
    PlotCurve line{.label = "model"}, low{.label = "95 %"}, high{.label = "95 %"};
    if (press) {
      for (const MeasuredForce& row : data.held_out) {
        rest.points.emplace_back(row.at, row.force_n);
        off_rest.points.emplace_back(row.at, model.press_force_n(m, result.u, row.at) - row.force_n);
      }
      constexpr int kPoints = 60;
      for (int i = 0; i <= kPoints; ++i) {
        const double depth = measurement.depths_mm.back() * i / kPoints;
        line.points.emplace_back(depth, model.press_force_n(m, result.u, depth));
      }
      low.points.emplace_back(0.0, 0.0);
      high.points.emplace_back(0.0, 0.0);
      for (const ForcePrediction& p : result.forces)
        if (p.measurement == measurement.name) {
          low.points.emplace_back(p.depth_mm, p.low_n);
          high.points.emplace_back(p.depth_mm, p.high_n);
        }
    } else {
      for (std::size_t i = 0; i < data.fitted.size(); ++i) line.points.emplace_back(data.fitted[i].at, predicted[i]);
    }
    curve.curves = {line, seen};
    residual.curves = {off};
    if (press) curve.curves.insert(curve.curves.end(), {low, high});
    if (!rest.points.empty()) {
      curve.curves.push_back(rest);
      residual.curves.push_back(off_rest);
    }
    files["curve_" + measurement.name + ".svg"] = to_svg(curve);
    files["residual_" + measurement.name + ".svg"] = to_svg(residual);
  }
  return files;
}

std::string profile_plot(const Unknown& unknown, const Fit& fit, Eigen::Index index,
                         const std::vector<ProfilePoint>& points) {
  const std::string name = unknown.measurement.empty() ? unknown.name : unknown.name + " of " + unknown.measurement;
  Plot plot{.title = name, .x_label = unknown.name, .y_label = "squared residuals above the least", .zero_in_x = false};
  PlotCurve cost{.label = "profile", .marks = true}, normal{.label = "by the covariance"},
      prior{.label = "prior alone"};
  const double sigma = std::sqrt(fit.covariance(index, index));
  for (const ProfilePoint& p : points) {
    const double u = unknown.u_of(p.value);
    cost.points.emplace_back(p.value, p.cost);
    normal.points.emplace_back(p.value, std::pow((u - fit.u[index]) / sigma, 2));
    prior.points.emplace_back(p.value, std::pow((u - unknown.u_mean()) / unknown.prior.sigma, 2));
  }
  plot.curves = {cost, normal, prior};
  return to_svg(plot);
}

}  // namespace tacipc
