#include "stages/study/identify/predictions.h"

#include <algorithm>
#include <cmath>

#include "common/base/rng.h"

namespace tacipc {
namespace {

/// Logarithm of the checked over the unchecked force at a depth.
double change_at(const CheckedPress& check, double depth_mm) {
  const Eigen::Vector2d as_it_is(1.0, 0.0), checked(0.0, 1.0);
  const double force = check.table.blend(as_it_is).at(depth_mm), other = check.table.blend(checked).at(depth_mm);
  return force > 0.0 && other > 0.0 ? std::log(other / force) : 0.0;
}

/// Mean change over the fitted rows, weighted as in the fit by (force / deviation)².
double mean_change(const CheckedPress& check, const MechanicsModel& model) {
  double sum = 0.0, weights = 0.0;
  for (const MeasuredForce& row : model.data(check.measurement).force->fitted) {
    const double weight = std::pow(row.force_n / row.sigma_n, 2);
    sum += weight * change_at(check, row.at);
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

/// Marker errors over the fitted markers, or over the others.
std::vector<MarkerErrors> marker_errors(const MechanicsModel& model, std::size_t measurement,
                                        const Posterior& posterior, bool fitted) {
  const MarkerMeasurement& m = *model.spec().measurements[measurement].markers;
  const MarkerData& data = *model.data(measurement).markers;
  using Both = std::pair<Eigen::Matrix2Xd, Eigen::Matrix2Xd>;
  const Both mean = model.marker_px(measurement, posterior.mean_u());
  constexpr int kDraws = 200;
  std::vector<Both> drawn;
  for (const Eigen::Index k : posterior.resampled(kDraws))
    drawn.push_back(model.marker_px(measurement, posterior.u.col(k)));
  const double noise = model.sigma_factor[measurement] * m.sigma_px;
  std::vector<MarkerErrors> out;
  const auto add = [&](const char* photograph, const MarkerField& field, Eigen::Matrix2Xd Both::*part) {
    const Eigen::Matrix2Xd& px = mean.*part;
    MarkerErrors e{.photograph = photograph, .fitted = fitted};
    for (Eigen::Index i = 0; i < px.cols(); ++i) {
      if (model.fits_marker(i) != fitted) continue;
      ++e.vectors;
      e.measured_px += field.moved_px.col(i).norm();
      e.error_px += (px.col(i) - field.moved_px.col(i)).norm();
      for (Eigen::Index k = 0; k < 2; ++k) {
        double square = noise * noise;
        for (const auto& draw : drawn) square += std::pow((draw.*part)(k, i) - px(k, i), 2) / kDraws;
        e.inside += std::abs(px(k, i) - field.moved_px(k, i)) <= 1.96 * std::sqrt(square);
      }
    }
    out.push_back(e);
  };
  add("press", data.press, &Both::first);
  add("press and shear", data.shear, &Both::second);
  return out;
}

}  // namespace

double model_error(const std::vector<CheckedPress>& checks, const MechanicsModel& model, std::size_t measurement,
                   double depth_mm) {
  double sum = 0.0;
  for (const CheckedPress& check : checks)
    if (check.measurement == measurement) sum += std::pow(change_at(check, depth_mm) - mean_change(check, model), 2);
  return std::sqrt(sum);
}

std::map<std::string, double> modulus_error(const std::vector<CheckedPress>& checks, const MechanicsModel& model) {
  std::map<std::string, double> sum, count, out;
  for (const CheckedPress& check : checks) {
    sum[check.check] += mean_change(check, model);
    count[check.check] += 1.0;
  }
  for (const auto& [name, total] : sum) out[name] = total / count[name];
  return out;
}

std::vector<ForcePrediction> predict_forces(const MechanicsModel& model, const Posterior& posterior,
                                            const std::vector<CheckedPress>& checks) {
  std::vector<ForcePrediction> out;
  const Eigen::VectorXd mean = posterior.mean_u();
  const auto& measurements = model.spec().measurements;
  for (std::size_t m = 0; m < measurements.size(); ++m) {
    if (measurements[m].kind != MeasurementKind::press) continue;
    const ForceData& data = *model.data(m).force;
    std::vector<ForcePrediction> rows;
    const auto row = [&](double depth, bool fitted, std::optional<double> measured) {
      rows.push_back(
          {.measurement = measurements[m].name, .depth_mm = depth, .fitted = fitted, .measured_n = measured});
    };
    for (const MeasuredForce& f : data.fitted) row(f.at, true, f.force_n);
    for (const MeasuredForce& f : data.held_out) row(f.at, false, f.force_n);
    for (const double depth : measurements[m].predict_mm)
      if (std::ranges::count(rows, depth, &ForcePrediction::depth_mm) == 0) row(depth, false, std::nullopt);
    std::ranges::stable_sort(rows, {}, &ForcePrediction::depth_mm);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      ForcePrediction& p = rows[r];
      p.force_n = model.press_force_n(m, mean, p.depth_mm);
      const double relative = model_error(checks, model, m, p.depth_mm);
      const double noise = std::hypot(measurements[m].sigma_n, measurements[m].sigma_relative * p.force_n);
      Eigen::VectorXd force(posterior.u.cols()), seen(posterior.u.cols());
      for (Eigen::Index k = 0; k < force.size(); ++k) {
        if (posterior.weight[k] <= 0.0) {
          force[k] = seen[k] = p.force_n;
          continue;
        }
        const auto counter = static_cast<std::uint64_t>(k);
        const auto stream = hash_of(p.measurement) + r;
        force[k] = model.press_force_n(m, posterior.u.col(k), p.depth_mm);
        seen[k] = force[k] * (1.0 + relative * random_normal(1, stream, 2 * counter)) +
                  noise * random_normal(1, stream, 2 * counter + 1);
      }
      p.parameter_sigma = posterior.deviation(force);
      p.model_sigma = relative * p.force_n;
      p.low_n = posterior.quantile(seen, 0.025);
      p.high_n = posterior.quantile(seen, 0.975);
    }
    out.insert(out.end(), rows.begin(), rows.end());
  }
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
        auto same = std::ranges::find_if(
            errors, [&](const MarkerErrors& o) { return !o.fitted && o.photograph == e.photograph; });
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

}  // namespace tacipc
