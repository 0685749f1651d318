// Colours of light as linear sRGB: black bodies, spectral lines, tone curve.
#pragma once

#include <array>

#include "common/base/types.h"

namespace tacipc {

/// Returns linear sRGB of a black body at `kelvin`, largest channel 1 (Planck's law).
std::array<double, 3> color_of_temperature(double kelvin);

/// Returns linear sRGB per unit luminance of a Gaussian spectrum with peak and full width at half maximum in nm.
/// Saturated colours lie outside the sRGB gamut and have negative channels.
std::array<double, 3> color_of_line(double peak_nm, double fwhm_nm);

}  // namespace tacipc
