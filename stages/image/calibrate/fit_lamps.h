// Places and widths of lamps, and what of them the photographs tell.
#pragma once

#include <vector>

#include "common/sensor/light_field.h"
#include "stages/image/calibrate/calibrate_config.h"
#include "stages/image/calibrate/gauss_newton.h"
#include "stages/image/calibrate/samples.h"

namespace tacipc {

/// Features of all contacts at a geometry, one matrix each.
std::vector<Eigen::MatrixXd> all_features(const std::vector<const Contact*>& contacts, const LightGeometry& geometry);

/// Weights that explain the contacts best, and their normal equations over the samples that are active under them.
struct Weights {
  Codes codes;
  std::vector<NormalEquations> equations;  // of each contact
};
Weights best_weights(const std::vector<const Contact*>& contacts, const std::vector<Eigen::MatrixXd>& features,
                     double ridge);

NormalEquations sum_of(const std::vector<NormalEquations>& equations);

/// Lamps of a geometry: positions, and widths if any lamp has one.
void set_lamps(LightGeometry& geometry, const std::vector<LampGuess>& lamps);

/// Azimuth (rad), tangent of elevation, ln distance (m) of each lamp, and its half width (rad) where the bounds leave
/// that free.
int parameters_per_lamp(const CalibrateConfig& config);
std::vector<LampGuess> lamps_at(std::vector<LampGuess> lamps, const Eigen::VectorXd& u, const CalibrateConfig& config);

/// Gauss–Newton within the bounds on the residual of the best weights (variable projection, Golub and Pereyra 1973),
/// without environment, so that the lamps explain as much as possible.
GaussNewtonResult fit_lamps(const std::vector<const Contact*>& contacts, const std::vector<LampGuess>& start,
                            LightGeometry geometry, const CalibrateConfig& config);

/// One parameter of one lamp after the fit.
struct LampKnowledge {
  double value = 0.0;
  double sigma = 0.0;  // posterior
  double prior = 0.0;  // deviation of a uniform distribution over the bounds
  bool told = false;   // by the photographs: variance below half the prior's, and inside the bounds
};

/// What the photographs tell of the lamps if the whole light, environment included, is free to explain them otherwise:
/// (JᵀJ / (m s²) + diag prior⁻²)⁻¹ at the fitted place, J of the residual of the best weights, s its root mean square,
/// m how many samples count as one, because neighbouring residuals agree.
std::vector<LampKnowledge> lamp_knowledge(const std::vector<const Contact*>& contacts,
                                          const std::vector<LampGuess>& lamps, LightGeometry geometry,
                                          const CalibrateConfig& config);

/// Neighbouring residuals agree over about 100 pixels: so many samples of a fit count as one.
double samples_per_fact(const CalibrateConfig& config);

}  // namespace tacipc
