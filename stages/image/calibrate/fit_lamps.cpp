#include "stages/image/calibrate/fit_lamps.h"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tacipc {
namespace {

Eigen::VectorXd parameters_of(const std::vector<LampGuess>& lamps, const CalibrateConfig& config) {
  const int each = parameters_per_lamp(config);
  Eigen::VectorXd u(static_cast<Eigen::Index>(lamps.size()) * each);
  for (std::size_t l = 0; l < lamps.size(); ++l) {
    const auto i = static_cast<Eigen::Index>(l) * each;
    u.segment<3>(i) << lamps[l].azimuth_rad, lamps[l].elevation_tan, std::log(lamps[l].distance_m);
    if (each > 3) u[i + 3] = lamps[l].half_width_rad;
  }
  return u;
}

/// Bounds and steps of the light sources' parameters.
GaussNewtonSettings range_of(const CalibrateConfig& config) {
  const LampBounds& bounds = config.bounds;
  std::vector<LampGuess> lower, upper;
  for (const LampGuess& lamp : config.lamps) {
    lower.push_back({lamp.azimuth_rad - bounds.azimuth_rad, bounds.distance_m[0], bounds.elevation_tan[0],
                     bounds.half_width_rad[0]});
    upper.push_back({lamp.azimuth_rad + bounds.azimuth_rad, bounds.distance_m[1], bounds.elevation_tan[1],
                     bounds.half_width_rad[1]});
  }
  const Eigen::VectorXd lowest = parameters_of(lower, config);
  return {
      .step = Eigen::VectorXd::Constant(lowest.size(), 1e-3), .lower = lowest, .upper = parameters_of(upper, config)};
}

/// Residuals of the best weights for given parameters of the light sources.
Eigen::VectorXd projected_residuals(const std::vector<const Contact*>& contacts, const std::vector<LampGuess>& lamps,
                                    LightGeometry& geometry, const CalibrateConfig& config) {
  set_lamps(geometry, lamps);
  const auto features = all_features(contacts, geometry);
  const Codes weights = best_weights(contacts, features, config.ridge).codes;
  std::vector<double> all;
  for (std::size_t b = 0; b < contacts.size(); ++b) {
    const Eigen::VectorXd part = residuals_of(contacts[b]->samples, features[b], weights);
    all.insert(all.end(), part.begin(), part.end());
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), std::ssize(all));
}

}  // namespace

std::vector<Eigen::MatrixXd> all_features(const std::vector<const Contact*>& contacts, const LightGeometry& geometry) {
  std::vector<Eigen::MatrixXd> features(contacts.size());
  tbb::parallel_for(std::size_t{0}, contacts.size(), [&](std::size_t i) {
    features[i] = feature_matrix(geometry, contacts[i]->view, contacts[i]->samples);
  });
  return features;
}

NormalEquations sum_of(const std::vector<NormalEquations>& equations) {
  NormalEquations sum;
  for (const NormalEquations& e : equations) sum.add(e);
  return sum;
}

Weights best_weights(const std::vector<const Contact*>& contacts, const std::vector<Eigen::MatrixXd>& features,
                     double ridge) {
  constexpr int kMaxRounds = 4;
  Weights best;
  std::vector<Codes> active(contacts.size());
  for (std::size_t b = 0; b < contacts.size(); ++b) active[b] = contacts[b]->samples.used;
  for (int round = 0; round < kMaxRounds; ++round) {
    std::vector<char> changed(contacts.size(), round == 0);
    best.equations.resize(contacts.size());
    tbb::parallel_for(std::size_t{0}, contacts.size(), [&](std::size_t b) {
      if (round > 0) {
        const Codes now = active_samples(contacts[b]->samples, features[b] * best.codes);
        changed[b] = now != active[b];
        active[b] = now;
      }
      if (changed[b]) best.equations[b] = normal_equations(features[b], contacts[b]->samples, active[b]);
    });
    if (std::ranges::none_of(changed, [](char c) { return c != 0; })) break;
    best.codes = sum_of(best.equations).solve(ridge);
  }
  return best;
}

void set_lamps(LightGeometry& geometry, const std::vector<LampGuess>& lamps) {
  geometry.lamps_m.clear();
  geometry.lamp_half_width_rad.clear();
  for (const LampGuess& lamp : lamps) {
    geometry.lamps_m.push_back(lamp.position_m());
    geometry.lamp_half_width_rad.push_back(lamp.half_width_rad);
  }
}

int parameters_per_lamp(const CalibrateConfig& config) {
  return config.bounds.half_width_rad[1] > config.bounds.half_width_rad[0] ? 4 : 3;
}

std::vector<LampGuess> lamps_at(std::vector<LampGuess> lamps, const Eigen::VectorXd& u, const CalibrateConfig& config) {
  const int each = parameters_per_lamp(config);
  for (std::size_t l = 0; l < lamps.size(); ++l) {
    const auto i = static_cast<Eigen::Index>(l) * each;
    lamps[l].azimuth_rad = u[i];
    lamps[l].elevation_tan = u[i + 1];
    lamps[l].distance_m = std::exp(u[i + 2]);
    if (each > 3) lamps[l].half_width_rad = u[i + 3];
  }
  return lamps;
}

GaussNewtonResult fit_lamps(const std::vector<const Contact*>& contacts, const std::vector<LampGuess>& start,
                            LightGeometry geometry, const CalibrateConfig& config) {
  geometry.environment_degree = 0;
  geometry.environment_depth = false;
  geometry.dome = {};
  const auto residuals = [&](const Eigen::VectorXd& at) {
    return projected_residuals(contacts, lamps_at(start, at, config), geometry, config);
  };
  return gauss_newton(residuals, parameters_of(start, config), range_of(config));
}

double samples_per_fact(const CalibrateConfig& config) {
  constexpr double kCorrelatedPixels = 100.0;
  return std::max(1.0, kCorrelatedPixels / (config.fit_stride_px * config.fit_stride_px));
}

std::vector<LampKnowledge> lamp_knowledge(const std::vector<const Contact*>& contacts,
                                          const std::vector<LampGuess>& lamps, LightGeometry geometry,
                                          const CalibrateConfig& config) {
  const GaussNewtonSettings range = range_of(config);
  const Eigen::VectorXd u = parameters_of(lamps, config);
  const auto residuals = [&](const Eigen::VectorXd& at) {
    return projected_residuals(contacts, lamps_at(lamps, at, config), geometry, config);
  };
  const Eigen::VectorXd here = residuals(u);
  Eigen::MatrixXd jacobian(here.size(), u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    Eigen::VectorXd moved = u;
    moved[i] += u[i] + range.step[i] > range.upper[i] ? -range.step[i] : range.step[i];
    jacobian.col(i) = (residuals(moved) - here) / (moved[i] - u[i]);
  }
  double count = 0.0;
  for (const Contact* contact : contacts) count += contact->samples.used.sum();
  const double variance = here.squaredNorm() / std::max(count, 1.0) * samples_per_fact(config);
  const Eigen::VectorXd prior = (range.upper - range.lower) / std::sqrt(12.0);
  Eigen::MatrixXd information = jacobian.transpose() * jacobian / std::max(variance, 1e-12);
  information.diagonal() += prior.cwiseAbs2().cwiseMax(1e-12).cwiseInverse();
  const Eigen::VectorXd posterior = information.inverse().diagonal();
  std::vector<LampKnowledge> out;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double edge = 1e-3 * (range.upper[i] - range.lower[i]);
    const bool inside = u[i] > range.lower[i] + edge && u[i] < range.upper[i] - edge;
    out.push_back({.value = u[i],
                   .sigma = std::sqrt(posterior[i]),
                   .prior = prior[i],
                   .told = inside && posterior[i] < 0.5 * prior[i] * prior[i]});
  }
  return out;
}

}  // namespace tacipc
