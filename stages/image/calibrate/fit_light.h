// Lamps, weights and balls fitted to photographs of ball presses.
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

/// One photograph of a ball, and where it is.
struct Ball : Contact {
  BallLabel label;
  double x_m = 0.0;  // of the ball's centre, frame S
  double y_m = 0.0;
  double depth_m = 0.0;
};

/// Which parts of the light a model has.
enum class ModelKind { lamps, environment, both };
std::string name_of(ModelKind kind);

/// Error of balls that were left out of the fit, root mean square over samples and channels, codes.
struct HeldOut {
  ModelKind kind;
  double rmse_codes = 0.0;
};

struct LightFit {
  LightField light;
  ModelKind kind = ModelKind::both;
  std::vector<HeldOut> held_out;           // of every kind the configuration allows
  std::optional<GaussNewtonResult> lamps;  // parameters as of fit_lamps
  std::vector<LampKnowledge> knowledge;    // of each of these parameters
  std::array<double, 3> rmse_codes{};      // per channel, of the fit itself
  double condition = 0.0;                  // of the weights' linear system
  double unused_fraction = 0.0;            // of the samples: clipped
  double contact_gap_m = 0.0;              // at the rim that labels show: as configured, or fitted
};

/// Membrane of a ball whose place is known.
MembraneView view_ball(const BallPress& press, const Ball& ball, const Sensor& sensor);

/// With `press` given, shapes belong to it: after a first fit every ball's centre and depth are fitted too, held by the
/// labels (label_sigma_px), and the light again. With fit_contact_gap the rim's gap becomes, after every such fit, the
/// median over balls of the gap at the label's radius, and the labels' depths follow: `press` is left with that rim.
/// Without, the balls' views stay as they are.
/// Known objects calibrate beside the balls; where `press` is given they find their places anew as the balls do.
/// The kind of model is chosen by cross-validation over the balls.
LightFit fit_light(std::vector<Ball>& balls, std::vector<KnownObject>& objects, BallPress* press, const Sensor& sensor,
                   const CalibrateConfig& config);

}  // namespace tacipc
