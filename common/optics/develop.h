// Converts radiance to the 8-bit image of a dataset: exposure, tone curve, noise transfer.
#pragma once

#include <cstdint>

#include "common/config/config.h"
#include "common/image/image.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Returns 255 f(v) with f the response curve, for v = exposure × signal. Values above full scale are kept, because
/// clipping happens once, at the end; negative values (from a colour matrix) become 0. `srgb` (IEC 61966-2-1): f(v) =
/// 12.92 v up to 0.0031308, then 1.055 v^(1/2.4) − 0.055; `gamma`: v^(1/gamma); `linear`: v.
double code_of(double v, const Response& response);
/// Inverse of code_of(), for values ≥ 0.
double value_of(double code, const Response& response);

/// Returns the signal of the photosites: S = M diag(white balance) L · (1 + v2 ρ² + v4 ρ⁴), with M the colour matrix
/// and ρ the distance from the image's centre over half the diagonal.
FloatImage camera_signal(const FloatImage& linear, const Camera& camera, const Response& response);

/// Returns the sensor's fixed exposure, or the exposure e at which the mean of min(code_of(e S), 255) over all pixels
/// and channels is mean_level · 255, to a relative 1e-12 or better.
/// \throw DataError if no light reaches the membrane.
double solve_exposure(const FloatImage& signal, const Response& response);

/// A signal and its values after the response curve, for some exposure and response.
struct Encoded {
  FloatImage signal = {};
  FloatImage codes = {};
};
/// Returns the values (0 … 255 and above, not rounded) of a whole image. Pixels with the signal of `known` are copied
/// from it, which saves work for an image with markers that equals the one without over most of its area.
/// \pre exposure and response are the same as for `known`
FloatImage encode(const FloatImage& signal, double exposure, const Response& response, const Encoded& known = {});

/// Adds shot and read noise in electrons: v' = v + √(N v + σ²) ξ / N for v = exposure × signal, with N the full well, σ
/// the read noise, and ξ ~ N(0, 1) a function of seed, stream, pixel and channel alone.
/// \return the signal v' / exposure
FloatImage add_noise(const FloatImage& signal, double exposure, const SensorNoise& noise, std::uint64_t seed,
                     std::uint64_t stream);

/// Synthesises a photograph of the reference: noise, then curve and rounding. Samples of a sensor with the same seed
/// get the same reference.
ByteImage synthetic_reference(const FloatImage& signal, double exposure, const Response& response,
                              const SensorNoise& noise, std::uint64_t seed);

/// An 8-bit image.
struct TactileImage {
  ByteImage image;
  double clipped_fraction = 0.0;  // fraction of the values outside 0 … 255 before clamping
};

/// Returns clamp(round(reference + simulated − simulated_reference), 0, 255); simulated values are 8-bit levels, not
/// rounded.
/// [paper, rendering: "subtract the simulation reference … add it to the reference collected from the real world"]
/// \pre equal shapes
TactileImage transfer_noise(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference);

/// Transfers the noise in linear light: out = code(value(reference) · simulated / simulated_reference), with signals
/// instead of 8-bit levels. If the simulated reference is dark, the difference is added instead.
TactileImage transfer_ratio(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference, double exposure, const Response& response);

/// Rounds and clamps.
TactileImage quantise(const FloatImage& codes);

}  // namespace tacipc
