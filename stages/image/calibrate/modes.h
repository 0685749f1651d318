// What `calibrate` does with LEDs that the sensor file knows; main.cpp has the third mode, unknown lamps.
#pragma once

#include "common/stage/stage.h"

namespace tacipc {

/// A whole sensor file from photographs (sensor_fit.h).
void calibrate_sensor(Stage& stage);

/// Colours of LEDs and the veil from images of each LED alone (led_intensities.h).
void calibrate_leds(Stage& stage);

}  // namespace tacipc
