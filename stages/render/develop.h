// From radiance to the 8-bit image a user loads: exposure, tone curve, noise transfer.
#pragma once

#include <cstdint>

#include "common/config.h"
#include "common/image.h"
#include "common/sensor.h"

namespace tacipc {

/// Noise of the photosites, for sensors without a reference photograph.
struct NoiseModel {
  double full_well_e = 0.0;  // electrons at full scale
  double read_e = 0.0;       // standard deviation of the read-out, electrons
  int seed = 0;

  static NoiseModel read(ConfigReader& in);
};

/// 255 f(v) with f the response curve, for v = exposure × radiance. Values above full scale are kept: clipping happens
/// once, at the end. sRGB (IEC 61966-2-1): f(v) = 12.92 v up to 0.0031308, then 1.055 v^(1/2.4) − 0.055.
double code_of(double v, const std::string& curve);

/// Exposure e at which the mean of min(code_of(e L), 255) over all pixels and channels is mean_level · 255, by
/// bisection on log e down to neighbouring numbers. \throw DataError if no light reaches the membrane.
double solve_exposure(const FloatImage& linear, const Response& response);

/// Codes of a whole image, not rounded.
FloatImage encode(const FloatImage& linear, double exposure, const Response& response);

/// What a photograph of the reference might look like: shot and read noise on electrons, then curve and rounding,
///   n = N v + √(N v + σ²) ξ,  code = round(code_of(clamp(n / N, 0, 1)))  with N full well, σ read noise, ξ ~ N(0, 1),
/// v = exposure × radiance. ξ depends on seed, pixel and channel alone, so every sample gets the same reference.
ByteImage synthetic_reference(const FloatImage& linear, double exposure, const Response& response,
                              const NoiseModel& noise);

struct TactileImage {
  ByteImage image;
  double clipped_fraction = 0.0;  // of the values: outside 0 … 255 before clamping
};

/// out = clamp(round(reference + simulated − simulated_reference), 0, 255), simulated values in codes, not rounded.
/// [paper, rendering: "subtract the simulation reference … add it to the reference collected from the real world"]
/// \pre equal shapes
TactileImage transfer_noise(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference);

}  // namespace tacipc
