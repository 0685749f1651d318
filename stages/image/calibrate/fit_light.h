// Fits light sources, weights and balls to photographs of ball presses.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/ball_press.h"
#include "common/sensor/light_field.h"
#include "common/sensor/membrane_view.h"
#include "common/sensor/sensor.h"
#include "stages/image/calibrate/fit_lamps.h"
#include "stages/image/calibrate/gauss_newton.h"
#include "stages/image/calibrate/known_object.h"
#include "stages/image/calibrate/samples.h"

namespace tacipc {

/// One photograph of a ball, and the ball's position.
struct Ball : Contact {
  BallLabel label;
  double x_m = 0.0;  // centre of the ball, frame S
  double y_m = 0.0;
  double depth_m = 0.0;
};

/// Parts of the light in a model.
enum class ModelKind { lamps, environment, both };
std::string name_of(ModelKind kind);

/// Error of balls that were left out of the fit: root mean square over samples and channels, grey levels.
struct HeldOut {
  ModelKind kind;
  double rmse_codes = 0.0;
};

/// Fitted light, with its errors and posterior.
struct LightFit {
  LightField light;
  ModelKind kind = ModelKind::both;
  std::vector<HeldOut> held_out;           // errors of every kind that the configuration allows
  std::optional<GaussNewtonResult> lamps;  // parameters in the order of fit_lamps
  std::vector<LampKnowledge> knowledge;    // posterior of each of these parameters
  std::array<double, 3> rmse_codes{};      // error of the fit itself, per channel
  double condition = 0.0;                  // condition of the weights' linear system
  double unused_fraction = 0.0;            // fraction of the samples that is clipped
  double contact_gap_m = 0.0;              // gap at the rim of the labels: as configured, or fitted
};

/// Membrane of a ball at a known position.
MembraneView view_ball(const BallPress& press, const Ball& ball, const Sensor& sensor);

/// Fits the light. The kind of model is chosen by cross-validation over the balls.
/// If `press` is given, it has the shapes. After a first fit every ball's centre and depth are also fitted, held by the
/// labels (label_sigma_px), and known objects are repositioned; then the light is fitted again. With fit_contact_gap
/// the rim's gap becomes, after every such fit, the median over balls of the gap at the label's radius; the labels'
/// depths follow, and `press` keeps that rim. Without `press` the balls' views stay as they are.
/// \param objects known objects that calibrate in addition to the balls
LightFit fit_light(std::vector<Ball>& balls, std::vector<KnownObject>& objects, BallPress* press, const Sensor& sensor,
                   const CalibrateConfig& config);

}  // namespace tacipc
