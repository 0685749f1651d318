// The relief of a known object's print, from the photograph that calibrates.
#pragma once

#include "common/sensor/light_field.h"
#include "common/sensor/print_relief.h"
#include "stages/image/calibrate/known_object.h"

namespace tacipc {

/// Photometric: with J the change of code per slope, r what the light leaves of the photograph, σ the deviation of
/// pixels outside the contact, and slopes of deviation `slope_sigma` expected,
///   δ = (JᵀJ / σ² + 1 / slope_sigma²)⁻¹ Jᵀ r / σ²
/// pixel by pixel, at most three deviations; clipped channels tell nothing. It is known where the object touched the
/// gel in the frame before already, so that the membrane is its surface.
/// \pre the object has a press, its view is the one of the fit
PrintRelief measure_relief(const KnownObject& object, const ByteImage& photograph, const ByteImage& background,
                           const LightField& light, const Sensor& sensor, double slope_sigma);

}  // namespace tacipc
