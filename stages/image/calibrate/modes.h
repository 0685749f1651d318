// Modes of `calibrate`: functions that read their flags and write their results.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// Fits the light of unknown light sources to photographs of balls and known objects (fit_light.h).
void calibrate_balls(Stage& stage);

/// Fits a whole sensor file to photographs (sensor_fit.h).
void calibrate_sensor(Stage& stage);

/// Fits the colours of LEDs and the veil to images of each LED alone (led_intensities.h).
void calibrate_leds(Stage& stage);

/// Fits another simulator's light to photographs of balls: a table, a network, or colours of light sources
/// (rival_config.h).
void calibrate_rival(Stage& stage);

}  // namespace tacipc
