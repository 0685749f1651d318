// Modes of `calibrate`: functions that read their flags and write their results.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// Light of unknown lamps from photographs of balls and known objects (fit_light.h).
void calibrate_balls(Stage& stage);

/// A whole sensor file from photographs (sensor_fit.h).
void calibrate_sensor(Stage& stage);

/// Colours of LEDs and the veil from images of each LED alone (led_intensities.h).
void calibrate_leds(Stage& stage);

/// Another simulator's light from photographs of balls: a table, a network, or colours of lamps (rival_config.h).
void calibrate_rival(Stage& stage);

}  // namespace tacipc
