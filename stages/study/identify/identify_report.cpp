#include "stages/study/identify/identify_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "common/benchmark/quiver.h"
#include "common/config/config_text.h"
#include "common/image/plot.h"

namespace tacipc {
namespace {

/// To three digits of the deviation.
std::string rounded(double value, double sigma) {
  if (!(sigma > 0.0)) return fmt::format("{:.6g}", value);
  const int digits = std::clamp(static_cast<int>(std::floor(std::log10(std::abs(value) / sigma + 1e-30))) + 3, 2, 8);
  return fmt::format("{:.{}g}", value, digits);
}

std::string deviation_text(double sigma) { return fmt::format("{:.2g}", sigma); }

/// Key of the sensor file that a parameter of the mechanics is.
std::string sensor_key(const std::string& name) {
  if (name == kModulus || name == kPoisson) return "material." + name;
  if (name == kThickness) return "gel." + name;
  if (name == kFriction) return "gel.friction";
  if (name == kMount) return "mount.compliance_mm_per_n";
  if (name == kShearMount) return "mount.shear_compliance_mm_per_n";
  return {};
}

std::string terms_yaml(const IdentifySpec& spec, const Unknowns& unknowns, const Eigen::VectorXd& u) {
  std::string out = "[";
  for (const auto& [part, time] : spec.relaxation)
    out += fmt::format("{}{{part: {:.6g}, time_s: {:.6g}}}", out.size() > 1 ? ", " : "",
                       unknowns.value(u, part.name, {}, 0.0), unknowns.value(u, time.name, {}, 0.0));
  return out + "]";
}

std::string path_of(const std::string& section, const std::string& key) {
  return section.empty() ? key : section + "." + key;
}

}  // namespace

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

std::vector<MarkerErrors> marker_errors(const MechanicsModel& model, std::size_t measurement,
                                        const Posterior& posterior, bool fitted) {
  const MarkerMeasurement& m = *model.spec().measurements[measurement].markers;
  const MarkerData& data = *model.data(measurement).markers;
  const auto mean = model.marker_px(measurement, posterior.mean_u());
  constexpr int kDraws = 200;
  std::vector<std::pair<Eigen::Matrix2Xd, Eigen::Matrix2Xd>> drawn;
  for (const Eigen::Index k : posterior.resampled(kDraws))
    drawn.push_back(model.marker_px(measurement, posterior.u.col(k)));
  const double noise = model.sigma_factor[measurement] * m.sigma_px;
  std::vector<MarkerErrors> out;
  const auto add = [&](const std::string& photograph, const MarkerField& field, const Eigen::Matrix2Xd& px,
                       auto&& part) {
    MarkerErrors e{.photograph = photograph, .fitted = fitted};
    for (Eigen::Index i = 0; i < px.cols(); ++i) {
      if (model.fits_marker(i) != fitted) continue;
      ++e.vectors;
      e.measured_px += field.moved_px.col(i).norm();
      e.error_px += (px.col(i) - field.moved_px.col(i)).norm();
      for (Eigen::Index k = 0; k < 2; ++k) {
        double square = noise * noise;
        for (const auto& draw : drawn) square += std::pow(part(draw)(k, i) - px(k, i), 2) / kDraws;
        e.inside += std::abs(px(k, i) - field.moved_px(k, i)) <= 1.96 * std::sqrt(square);
      }
    }
    out.push_back(e);
  };
  add("press", data.press, mean.first, [](const auto& both) -> const Eigen::Matrix2Xd& { return both.first; });
  add("press and shear", data.shear, mean.second,
      [](const auto& both) -> const Eigen::Matrix2Xd& { return both.second; });
  return out;
}

std::map<std::size_t, std::vector<MarkerErrors>> all_marker_errors(MechanicsModel& model, const Posterior& posterior) {
  std::map<std::size_t, std::vector<MarkerErrors>> out;
  for (std::size_t m = 0; m < model.spec().measurements.size(); ++m)
    if (model.spec().measurements[m].markers) out[m] = marker_errors(model, m, posterior, true);
  if (out.empty()) return out;
  const std::vector<double> factors = model.sigma_factor;
  for (const auto part : {MechanicsModel::Markers::even, MechanicsModel::Markers::odd}) {
    model.fitted_markers = part;
    model.sigma_factor.assign(factors.size(), 1.0);
    const Fit fit = fit_mechanics(model);
    const Posterior half = draw_posterior(model, fit, model.spec().draws, model.spec().seed);
    for (auto& [m, errors] : out)
      for (const MarkerErrors& e : marker_errors(model, m, half, false)) {
        auto same = std::find_if(errors.begin(), errors.end(),
                                 [&](const MarkerErrors& o) { return !o.fitted && o.photograph == e.photograph; });
        if (same == errors.end()) {
          errors.push_back(e);
          continue;
        }
        same->vectors += e.vectors;
        same->measured_px += e.measured_px;
        same->error_px += e.error_px;
        same->inside += e.inside;
      }
  }
  model.fitted_markers = MechanicsModel::Markers::all;
  model.sigma_factor = factors;
  for (auto& [m, errors] : out)
    for (MarkerErrors& e : errors) {
      e.measured_px /= e.vectors;
      e.error_px /= e.vectors;
      e.inside /= 2 * e.vectors;
    }
  return out;
}

double misfit(const MechanicsModel& model, std::size_t measurement, const Eigen::VectorXd& u) {
  const Eigen::VectorXd off =
      (model.predicted(measurement, u) - model.measured(measurement)).cwiseQuotient(model.sigma(measurement));
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
    for (auto& [key, value] : Value::Map{{"value", e.value},
                                         {"sigma", e.sigma},
                                         {"interval_95", std::vector<double>{e.low, e.high}},
                                         {"prior_mean", e.prior.mean},
                                         {e.prior.logarithmic ? "prior_factor" : "prior_sigma",
                                          e.prior.logarithmic ? std::exp(e.prior.sigma) : e.prior.sigma},
                                         {"told_by", e.told ? "measurements" : "prior"}})
      line.emplace_back(key, value);
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
      off.points.emplace_back(data.fitted[i].at, predicted[static_cast<Eigen::Index>(i)] - data.fitted[i].force_n);
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
      for (std::size_t i = 0; i < data.fitted.size(); ++i)
        line.points.emplace_back(data.fitted[i].at, predicted[static_cast<Eigen::Index>(i)]);
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

std::map<std::string, std::string> sensor_changes(const MechanicsModel& model, const Eigen::VectorXd& u) {
  std::map<std::string, std::string> out;
  for (Eigen::Index i = 0; i < model.unknowns().size(); ++i) {
    const Unknown& unknown = model.unknowns()[i];
    const std::string key = unknown.measurement.empty() ? sensor_key(unknown.name) : "";
    if (!key.empty()) out[key] = fmt::format("{:.6g}", unknown.value_of(u[i]));
  }
  if (!model.spec().relaxation.empty()) out["material.relaxation"] = terms_yaml(model.spec(), model.unknowns(), u);
  return out;
}

std::string fitted_sensor(const std::string& text, const std::string& name, const IdentifyResult& result) {
  ConfigText file(text, name);
  std::map<std::string, std::string> said;  // key → note
  const auto put = [&](const std::string& key, const std::string& yaml) {
    ConfigReader in = ConfigReader::from_text(file.text(), name);
    const std::string section = key.substr(0, key.find('.')), inner = key.substr(key.find('.') + 1);
    const bool there = in.has(section) && in.section(section).has(inner);
    there ? file.set(key, yaml) : file.add(key, yaml);
  };
  for (const auto& [key, yaml] : sensor_changes(result.model, result.u)) {
    put(key, yaml);
    put(key + "_src", "derived");
    std::string deviation;
    for (const Estimate& e : result.estimates)
      if (e.measurement.empty() && sensor_key(e.name) == key)
        deviation = " ± " + deviation_text(e.sigma) + (e.told ? "" : ", by its prior");
    said[key] = "[fitted" + deviation + "]";
  }
  ConfigReader in = ConfigReader::from_text(file.text(), name);
  const Sensor sensor = Sensor::read(in);
  in.finish();
  for (const auto& [path, source] : sensor.sources)
    said.emplace(path, source == "known" ? "[measured]" : source == "derived" ? "[derived]" : "[guess]");
  static const std::regex section_line(R"(^(\w+):\s*(#.*)?$)"), value_line(R"(^  (\w+): ([^#]*[^# ])\s*(#\s?(.*))?$)");
  std::string out, section, line;
  std::istringstream lines(file.text());
  while (std::getline(lines, line)) {
    std::smatch match;
    if (std::regex_match(line, match, section_line))
      section = match[1];
    else if (!line.empty() && line[0] != ' ' && line[0] != '#')
      section.clear();
    const bool mechanics = section == "gel" || section == "material" || section == "mount";
    if (mechanics && std::regex_match(line, match, value_line)) {
      const auto note = said.find(path_of(section, match[1]));
      const std::string old = note != said.end() && note->second.starts_with("[fitted") ? "" : match[4].str();
      if (note != said.end())
        line =
            fmt::format("  {}: {}  # {}{}", match[1].str(), match[2].str(), note->second, old.empty() ? "" : " " + old);
    }
    out += line + '\n';
  }
  return out;
}

Ensemble ensemble_of(const IdentifyResult& result, const std::filesystem::path& sensor, int members) {
  Ensemble out{.title = "drawn from what " + result.model.spec().title + " left uncertain", .sensor = sensor};
  for (const Eigen::Index column : result.posterior.resampled(members)) {
    EnsembleMember member{.name = fmt::format("m{:02}", out.members.size())};
    for (const auto& change : sensor_changes(result.model, result.posterior.u.col(column)))
      member.set.push_back(change);
    out.members.push_back(std::move(member));
  }
  return out;
}

}  // namespace tacipc
