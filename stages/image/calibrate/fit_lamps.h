// Fits positions and widths of light sources, and determines how far the photographs constrain them.
#pragma once

#include <vector>

#include "common/sensor/light_field.h"
#include "stages/image/calibrate/calibrate_config.h"
#include "stages/image/calibrate/gauss_newton.h"
#include "stages/image/calibrate/samples.h"

namespace tacipc {

/// Features of all contacts for a light geometry, one matrix each.
std::vector<Eigen::MatrixXd> all_features(const std::vector<const Contact*>& contacts, const LightGeometry& geometry);

/// Weights that explain the contacts best, and their normal equations over the samples that are active under them.
struct Weights {
  Codes codes;
  std::vector<NormalEquations> equations;  // normal equations of each contact
};
Weights best_weights(const std::vector<const Contact*>& contacts, const std::vector<Eigen::MatrixXd>& features,
                     double ridge);

NormalEquations sum_of(const std::vector<NormalEquations>& equations);

/// Sets the light sources of a geometry: positions, and widths if any source has one.
void set_lamps(LightGeometry& geometry, const std::vector<LampGuess>& lamps);

/// Number of parameters per light source: azimuth (rad), tangent of elevation, ln distance (m), and the half width
/// (rad) if the bounds leave it free.
int parameters_per_lamp(const CalibrateConfig& config);
std::vector<LampGuess> lamps_at(std::vector<LampGuess> lamps, const Eigen::VectorXd& u, const CalibrateConfig& config);

/// Fits the light sources by Gauss–Newton within the bounds on the residual of the best weights (variable projection,
/// Golub and Pereyra 1973), without environment, so that the sources explain as much as possible.
GaussNewtonResult fit_lamps(const std::vector<const Contact*>& contacts, const std::vector<LampGuess>& start,
                            LightGeometry geometry, const CalibrateConfig& config);

/// One parameter of one light source after the fit.
struct LampKnowledge {
  double value = 0.0;
  double sigma = 0.0;  // posterior standard deviation
  double prior = 0.0;  // standard deviation of a uniform distribution over the bounds
  bool told = false;   // determined by the photographs: variance below half the prior's, and inside the bounds
};

/// Posterior of the light sources if the whole light, environment included, is free to explain the photographs
/// otherwise: (JᵀJ / (m s²) + diag prior⁻²)⁻¹ at the fit. J is the Jacobian of the residual of the best weights, s the
/// residual's root mean square, and m the number of samples that count as one, because neighbouring residuals
/// correlate.
std::vector<LampKnowledge> lamp_knowledge(const std::vector<const Contact*>& contacts,
                                          const std::vector<LampGuess>& lamps, LightGeometry geometry,
                                          const CalibrateConfig& config);

/// Number of samples of a fit that count as one: neighbouring residuals correlate over about 100 pixels.
double samples_per_fact(const CalibrateConfig& config);

}  // namespace tacipc
