#include "common/optics/develop.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "common/base/simd.h"
#include "common/base/tone_curve.h"
#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

ToneCurve curve_of(const Response& response) { return ToneCurve::named(response.curve, response.gamma); }

/// Returns code_of() for eight values.
TACIPC_INLINE Pack codes_of(const Pack& v, const ToneCurve& f) {
  constexpr double kLeast = std::numeric_limits<double>::min();
  const Pack power = exponential(logarithm(larger(v, Pack{} + kLeast)) * (1.0 / f.gamma));
  return choose(v, 255.0 * choose(v - f.toe, f.scale * power - f.offset, f.slope * v), Pack{});
}

/// Returns exposure × signals i … i + 7 of `count`; lanes beyond `count` are 0, whose value is 0.
TACIPC_INLINE Pack exposed(const float* signal, std::size_t i, std::size_t count, double exposure) {
  Pack v;
  for (std::size_t l = 0; l < kLanes; ++l) v[l] = i + l < count ? signal[i + l] : 0.0F;
  return exposure * v;
}

/// Computes the 8-bit values of a row of signals. Values of equal signals are copied from `known`.
TACIPC_CLONES void encode_row(const float* signal, std::size_t count, double exposure, const ToneCurve& f,
                              const float* known, const float* known_codes, float* codes) {
  for (std::size_t i = 0; i < count; i += kLanes) {
    const std::size_t some = std::min<std::size_t>(kLanes, count - i);
    if (known && std::equal(signal + i, signal + i + some, known + i)) {
      std::copy_n(known_codes + i, some, codes + i);
      continue;
    }
    const Pack found = codes_of(exposed(signal, i, count, exposure), f);
    for (std::size_t l = 0; l < some; ++l) codes[i + l] = static_cast<float>(found[l]);
  }
}

/// Returns Σ min(value, 255) over a row of signals.
TACIPC_CLONES double sum_of_codes(const float* signal, std::size_t count, double exposure, const ToneCurve& f) {
  Pack sum = {};
  for (std::size_t i = 0; i < count; i += kLanes)
    sum += smaller(codes_of(exposed(signal, i, count, exposure), f), Pack{} + 255.0);
  double total = 0.0;
  for (int l = 0; l < kLanes; ++l) total += sum[l];
  return total;
}

std::size_t row_length(const FloatImage& image) { return static_cast<std::size_t>(image.width) * image.channels; }

}  // namespace

double code_of(double v, const Response& response) { return curve_of(response).code_of(v); }

double value_of(double code, const Response& response) { return curve_of(response).value_of(code); }

FloatImage camera_signal(const FloatImage& linear, const Camera& camera, const Response& response) {
  FloatImage out(linear.width, linear.height, 3);
  tbb::parallel_for(0, linear.height, [&](int y) {
    for (int x = 0; x < linear.width; ++x) {
      const double falloff = vignetting(camera, x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
          sum += response.color_matrix[3 * c + k] * response.white_balance[k] * linear.at(x, y, static_cast<int>(k));
        out.at(x, y, static_cast<int>(c)) = static_cast<float>(falloff * sum);
      }
    }
  });
  return out;
}

namespace {

constexpr double kExposureTolerance =
    1e-12;  // relative tolerance of the exposure and of the mean: the accuracy of the sum in double precision

/// Finds log e at which `excess`, which grows with log e, vanishes, starting near `guess`. Steps double from `step`
/// until they bracket the root; then false position, with the excess at an unchanged end halved (Illinois), closes in
/// from both sides.
/// \param negligible largest excess that counts as zero
/// \return nothing if 60 steps do not reach the root
template <typename Excess>
std::optional<double> solve_increasing(const Excess& excess, double guess, double step, double negligible) {
  double low = guess, low_excess = excess(low), high = low, high_excess = low_excess;
  double widening = step;
  for (int steps = 0; low_excess >= 0.0 && steps < 60; ++steps, widening *= 2.0) {
    high = low;
    high_excess = low_excess;
    low_excess = excess(low -= std::min(widening, std::numbers::ln2));
  }
  for (int steps = 0; high_excess < 0.0; ++steps, widening *= 2.0) {
    if (steps == 60) return std::nullopt;
    low = high;
    low_excess = high_excess;
    high_excess = excess(high += std::min(widening, std::numbers::ln2));
  }
  constexpr int kMaxIterations = 100;
  int stayed = 0;  // > 0: number of times `high` stayed, < 0: `low`
  for (int i = 0; i < kMaxIterations && high - low > kExposureTolerance && high_excess > 0.0; ++i) {
    const double share = std::clamp(low_excess / (low_excess - high_excess), 1e-3, 1.0 - 1e-3);
    const double at = low + share * (high - low);
    if (!(low < at && at < high)) break;
    const double here = excess(at);
    if (std::abs(here) <= negligible) return at;
    if (here < 0.0) {
      low = at;
      low_excess = here;
      stayed = std::max(0, stayed) + 1;
      if (stayed > 1) high_excess *= 0.5;
    } else {
      high = at;
      high_excess = here;
      stayed = std::min(0, stayed) - 1;
      if (stayed < -1) low_excess *= 0.5;
    }
  }
  return high;
}

}  // namespace

double solve_exposure(const FloatImage& linear, const Response& response) {
  if (response.exposure) return *response.exposure;
  const float brightest = *std::ranges::max_element(linear.pixels);
  if (!(brightest > 0.0f)) throw DataError("no light reaches the front face: check the positions of the LEDs");
  // A subset of the pixels gives nearly the same exposure in a thirtieth of the time.
  constexpr std::size_t kStride = 31;
  double guess = std::log(1.0 / brightest), step = std::numbers::ln2;
  if (linear.pixels.size() > 1000 * kStride) {
    const auto excess = [&](double log_exposure) {
      const double exposure = std::exp(log_exposure);
      double sum = 0.0;
      for (std::size_t i = 0; i < linear.pixels.size(); i += kStride)
        sum += std::min(code_of(exposure * linear.pixels[i], response), 255.0) - response.mean_level * 255.0;
      return sum;
    };
    constexpr double kEnough = 1e-3;  // 8-bit levels
    const std::size_t count = linear.pixels.size() / kStride;
    if (const auto found = solve_increasing(excess, guess, step, kEnough * static_cast<double>(count))) {
      guess = *found;
      step = 1e-3;
    }
  }
  const ToneCurve curve = curve_of(response);
  const std::size_t length = row_length(linear);
  const double wanted = response.mean_level * 255.0 * static_cast<double>(linear.pixels.size());
  const auto excess = [&](double log_exposure) {
    const double exposure = std::exp(log_exposure);
    // Sums are per row, so that rounding does not depend on threads.
    std::vector<double> rows(linear.height);
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t y) {
      rows[y] = sum_of_codes(&linear.pixels[y * length], length, exposure, curve);
    });
    return std::accumulate(rows.begin(), rows.end(), 0.0) - wanted;
  };
  const auto found = solve_increasing(excess, guess, step, kExposureTolerance * wanted);
  if (!found)
    throw DataError("no exposure gives the mean level {}: too much of the image is black", response.mean_level);
  return std::exp(*found);
}

FloatImage encode(const FloatImage& signal, double exposure, const Response& response, const Encoded& known) {
  FloatImage codes(signal.width, signal.height, signal.channels);
  const std::size_t length = row_length(signal);
  const ToneCurve curve = curve_of(response);
  const bool knows = known.signal.pixels.size() == signal.pixels.size();
  tbb::parallel_for(0, signal.height, [&](int y) {
    const std::size_t first = static_cast<std::size_t>(y) * length;
    encode_row(signal.pixels.data() + first, length, exposure, curve,
               knows ? known.signal.pixels.data() + first : nullptr,
               knows ? known.codes.pixels.data() + first : nullptr, codes.pixels.data() + first);
  });
  return codes;
}

FloatImage add_noise(const FloatImage& signal, double exposure, const SensorNoise& noise, std::uint64_t seed,
                     std::uint64_t stream) {
  FloatImage out(signal.width, signal.height, signal.channels);
  const std::size_t length = row_length(signal);
  tbb::parallel_for(0, signal.height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = row * length; i < (row + 1) * length; ++i) {
      const double electrons = noise.full_well_e * exposure * std::max(0.0f, signal.pixels[i]);
      const double deviation = std::sqrt(electrons + noise.read_e * noise.read_e);
      const double noisy = electrons + deviation * random_normal(seed, stream, i);
      out.pixels[i] = static_cast<float>(noisy / (noise.full_well_e * exposure));
    }
  });
  return out;
}

ByteImage synthetic_reference(const FloatImage& signal, double exposure, const Response& response,
                              const SensorNoise& noise, std::uint64_t seed) {
  constexpr std::uint64_t kReferenceStream = 1;
  return quantise(encode(add_noise(signal, exposure, noise, seed, kReferenceStream), exposure, response)).image;
}

namespace {

/// Makes the image of values `code(i)`, as large as `like`.
template <typename T, typename Code>
TactileImage clamped(const Image<T>& like, const Code& code) {
  TactileImage out{.image = ByteImage(like.width, like.height, like.channels)};
  std::int64_t clipped = 0;
  for (std::size_t i = 0; i < like.pixels.size(); ++i) {
    const long rounded = std::lround(code(i));
    clipped += rounded < 0 || rounded > 255;
    out.image.pixels[i] = static_cast<std::uint8_t>(std::clamp(rounded, 0L, 255L));
  }
  out.clipped_fraction = static_cast<double>(clipped) / static_cast<double>(like.pixels.size());
  return out;
}

}  // namespace

TactileImage quantise(const FloatImage& codes) {
  return clamped(codes, [&](std::size_t i) { return codes.pixels[i]; });
}

TactileImage transfer_noise(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference) {
  assert(reference.pixels.size() == simulated.pixels.size());
  assert(reference.pixels.size() == simulated_reference.pixels.size());
  return clamped(reference, [&](std::size_t i) {
    return reference.pixels[i] + (static_cast<double>(simulated.pixels[i]) - simulated_reference.pixels[i]);
  });
}

TactileImage transfer_ratio(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference, double exposure, const Response& response) {
  assert(reference.pixels.size() == simulated.pixels.size());
  assert(reference.pixels.size() == simulated_reference.pixels.size());
  constexpr double kSmallestDivisor = 1e-4;  // fraction of full scale; ratios to smaller values are meaningless
  FloatImage codes(reference.width, reference.height, reference.channels);
  tbb::parallel_for(0, reference.height, [&](int y) {
    const std::size_t length = row_length(codes), row = static_cast<std::size_t>(y);
    for (std::size_t i = row * length; i < (row + 1) * length; ++i) {
      const double real = value_of(reference.pixels[i], response);
      const double with = exposure * simulated.pixels[i], without = exposure * simulated_reference.pixels[i];
      codes.pixels[i] = static_cast<float>(
          code_of(without > kSmallestDivisor ? real * with / without : real + with - without, response));
    }
  });
  return quantise(codes);
}

}  // namespace tacipc
