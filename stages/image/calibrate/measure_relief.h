// Measures the relief of a known object's print on the photograph that calibrates.
#pragma once

#include "common/sensor/light_field.h"
#include "common/sensor/print_relief.h"
#include "stages/image/calibrate/known_object.h"

namespace tacipc {

/// Photometric relief. The slopes change pixel by pixel by
///   δ = (JᵀJ / σ² + 1 / slope_sigma²)⁻¹ Jᵀ r / σ²,
/// at most three standard deviations. J is the change of grey level per slope, r the photograph's residual under the
/// light, σ the standard deviation of pixels outside the contact, and `slope_sigma` that of the expected slopes.
/// Clipped channels do not count. The relief is known where the object already touched the gel in the previous frame,
/// so that the membrane is the object's surface.
/// \pre the object has a press, and its view is the fitted one
PrintRelief measure_relief(const KnownObject& object, const ByteImage& photograph, const ByteImage& background,
                           const LightField& light, const Sensor& sensor, double slope_sigma);

}  // namespace tacipc
