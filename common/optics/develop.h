// From radiance to the 8-bit image a user loads: exposure, tone curve, noise transfer.
#pragma once

#include <cstdint>

#include "common/config/config.h"
#include "common/image/image.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// 255 f(v) with f the response curve, for v = exposure × signal. Values above full scale are kept: clipping happens
/// once, at the end; negative ones (a colour matrix makes them) are 0. `srgb` (IEC 61966-2-1): f(v) = 12.92 v up to
/// 0.0031308, then 1.055 v^(1/2.4) − 0.055; `gamma`: v^(1/gamma); `linear`: v.
double code_of(double v, const Response& response);
/// Its inverse, for codes ≥ 0.
double value_of(double code, const Response& response);

/// What the photosites get of the radiance: S = M diag(white balance) L · (1 + v2 ρ² + v4 ρ⁴), M the colour matrix, ρ
/// the distance from the image's centre over half the diagonal.
FloatImage camera_signal(const FloatImage& linear, const Camera& camera, const Response& response);

/// The sensor's fixed exposure, or the exposure e at which the mean of min(code_of(e S), 255) over all pixels and
/// channels is mean_level · 255, to a relative 1e-12 or better.
/// \throw DataError if no light reaches the membrane.
double solve_exposure(const FloatImage& signal, const Response& response);

/// A signal with its codes at some exposure and response.
struct Encoded {
  FloatImage signal = {};
  FloatImage codes = {};
};
/// Codes of a whole image, not rounded; with less work where `signal` is that of `known`, as most of an image with
/// markers is that without. \pre exposure and response are those of `known`
FloatImage encode(const FloatImage& signal, double exposure, const Response& response, const Encoded& known = {});

/// Shot and read noise on electrons: v' = v + √(N v + σ²) ξ / N for v = exposure × signal, N full well, σ read noise,
/// ξ ~ N(0, 1) a function of seed, stream, pixel and channel alone. Returned over the exposure again, as a signal.
FloatImage add_noise(const FloatImage& signal, double exposure, const SensorNoise& noise, std::uint64_t seed,
                     std::uint64_t stream);

/// What a photograph of the reference might look like: noise, then curve and rounding. The same seed gives
/// every sample of a sensor the same one.
ByteImage synthetic_reference(const FloatImage& signal, double exposure, const Response& response,
                              const SensorNoise& noise, std::uint64_t seed);

struct TactileImage {
  ByteImage image;
  double clipped_fraction = 0.0;  // of the values: outside 0 … 255 before clamping
};

/// out = clamp(round(reference + simulated − simulated_reference), 0, 255), simulated values in codes, not rounded.
/// [paper, rendering: "subtract the simulation reference … add it to the reference collected from the real world"]
/// \pre equal shapes
TactileImage transfer_noise(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference);

/// The same in linear light: out = code(value(reference) · simulated / simulated_reference), signals instead of codes.
/// Where the simulated reference is dark the difference is added instead.
TactileImage transfer_ratio(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference, double exposure, const Response& response);

/// Rounded and clamped, nothing else.
TactileImage quantise(const FloatImage& codes);

}  // namespace tacipc
