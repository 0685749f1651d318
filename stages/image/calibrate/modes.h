// What `calibrate` does beside unknown lamps, which are in main.cpp.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// A whole sensor file from photographs (sensor_fit.h).
void calibrate_sensor(Stage& stage);

/// Colours of LEDs and the veil from images of each LED alone (led_intensities.h).
void calibrate_leds(Stage& stage);

/// Another simulator's light from photographs of balls: a table, a network, or colours of lamps (rival_config.h).
void calibrate_rival(Stage& stage);

}  // namespace tacipc
