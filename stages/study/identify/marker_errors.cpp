#include "stages/study/identify/marker_errors.h"

#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

/// Sums over the markers that are fitted, or over those that are not.
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

}  // namespace

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
