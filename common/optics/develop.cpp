#include "common/optics/develop.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "common/sensor/camera_model.h"

namespace tacipc {
namespace {

/// Sum over an image, row by row, so that the threads leave no trace in the rounding.
template <typename Function>
double sum_rows(int height, std::size_t row_length, const Function& value) {
  std::vector<double> rows(static_cast<std::size_t>(height), 0.0);
  tbb::parallel_for(0, height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = row * row_length; i < (row + 1) * row_length; ++i) rows[row] += value(i);
  });
  double sum = 0.0;
  for (const double row : rows) sum += row;
  return sum;
}

std::size_t row_length(const FloatImage& image) {
  return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
}

}  // namespace

double code_of(double v, const Response& response) {
  if (v <= 0.0) return 0.0;
  if (response.curve == "linear") return 255.0 * v;
  if (response.curve == "gamma") return 255.0 * std::pow(v, 1.0 / response.gamma);
  return 255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055);
}

double value_of(double code, const Response& response) {
  const double f = code / 255.0;
  if (response.curve == "linear") return f;
  if (response.curve == "gamma") return std::pow(f, response.gamma);
  return f <= 12.92 * 0.0031308 ? f / 12.92 : std::pow((f + 0.055) / 1.055, 2.4);
}

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

double solve_exposure(const FloatImage& linear, const Response& response) {
  if (response.exposure) return *response.exposure;
  const float brightest = *std::max_element(linear.pixels.begin(), linear.pixels.end());
  if (!(brightest > 0.0f)) throw DataError("no light reaches the front face: check the positions of the LEDs");
  const double wanted = response.mean_level * 255.0 * static_cast<double>(linear.pixels.size());
  const auto total = [&](double exposure) {
    return sum_rows(linear.height, row_length(linear),
                    [&](std::size_t i) { return std::min(code_of(exposure * linear.pixels[i], response), 255.0); });
  };
  // Steps of a factor of two until the wanted mean lies between two of them; then false position on log e, whose
  // staying end counts half (Illinois), so that it closes in from both sides: some ten images instead of sixty.
  const double step = std::log(2.0);
  double low = std::log(1.0 / brightest), low_excess = total(std::exp(low)) - wanted, high = low,
         high_excess = low_excess;
  for (int halvings = 0; low_excess >= 0.0 && halvings < 60; ++halvings) {
    high = low;
    high_excess = low_excess;
    low_excess = total(std::exp(low -= step)) - wanted;
  }
  for (int doublings = 0; high_excess < 0.0; ++doublings) {
    if (doublings == 60)
      throw DataError("no exposure gives the mean level {}: too much of the image is black", response.mean_level);
    low = high;
    low_excess = high_excess;
    high_excess = total(std::exp(high += step)) - wanted;
  }
  constexpr int kMaxIterations = 100;
  constexpr double kRelativeTolerance =
      1e-12;       // of the exposure and of the mean: what summing leaves of a double's digits
  int stayed = 0;  // > 0: `high` did so often, < 0: `low`
  for (int i = 0; i < kMaxIterations && high - low > kRelativeTolerance && high_excess > 0.0; ++i) {
    const double share = std::clamp(low_excess / (low_excess - high_excess), 1e-3, 1.0 - 1e-3);
    const double at = low + share * (high - low);
    if (!(low < at && at < high)) break;
    const double excess = total(std::exp(at)) - wanted;
    if (std::abs(excess) <= kRelativeTolerance * wanted) return std::exp(at);
    if (excess < 0.0) {
      low = at;
      low_excess = excess;
      stayed = std::max(0, stayed) + 1;
      if (stayed > 1) high_excess *= 0.5;
    } else {
      high = at;
      high_excess = excess;
      stayed = std::min(0, stayed) - 1;
      if (stayed < -1) low_excess *= 0.5;
    }
  }
  return std::exp(high);
}

FloatImage encode(const FloatImage& linear, double exposure, const Response& response) {
  FloatImage codes(linear.width, linear.height, linear.channels);
  const std::size_t length = row_length(linear);
  tbb::parallel_for(0, linear.height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = row * length; i < (row + 1) * length; ++i) {
      codes.pixels[i] = static_cast<float>(code_of(exposure * linear.pixels[i], response));
    }
  });
  return codes;
}

FloatImage encode(const FloatImage& signal, double exposure, const Response& response, const Encoded& known) {
  if (known.signal.pixels.size() != signal.pixels.size()) return encode(signal, exposure, response);
  FloatImage codes(signal.width, signal.height, signal.channels);
  const std::size_t length = row_length(signal);
  tbb::parallel_for(0, signal.height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = row * length; i < (row + 1) * length; ++i) {
      const float value = signal.pixels[i];
      codes.pixels[i] = value == known.signal.pixels[i] ? known.codes.pixels[i]
                                                        : static_cast<float>(code_of(exposure * value, response));
    }
  });
  return codes;
}

FloatImage add_noise(const FloatImage& signal, double exposure, const NoiseModel& noise, std::uint64_t stream) {
  FloatImage out(signal.width, signal.height, signal.channels);
  const std::size_t length = row_length(signal);
  tbb::parallel_for(0, signal.height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = row * length; i < (row + 1) * length; ++i) {
      const double electrons = noise.full_well_e * exposure * std::max(0.0f, signal.pixels[i]);
      const double deviation = std::sqrt(electrons + noise.read_e * noise.read_e);
      const double noisy = electrons + deviation * random_normal(noise.seed, stream, i);
      out.pixels[i] = static_cast<float>(noisy / (noise.full_well_e * exposure));
    }
  });
  return out;
}

ByteImage synthetic_reference(const FloatImage& signal, double exposure, const Response& response,
                              const NoiseModel& noise) {
  constexpr std::uint64_t kReferenceStream = 1;
  return quantise(encode(add_noise(signal, exposure, noise, kReferenceStream), exposure, response)).image;
}

TactileImage quantise(const FloatImage& codes) {
  TactileImage out{.image = ByteImage(codes.width, codes.height, codes.channels)};
  std::int64_t clipped = 0;
  for (std::size_t i = 0; i < codes.pixels.size(); ++i) {
    const long code = std::lround(codes.pixels[i]);
    clipped += code < 0 || code > 255;
    out.image.pixels[i] = static_cast<std::uint8_t>(std::clamp(code, 0L, 255L));
  }
  out.clipped_fraction = static_cast<double>(clipped) / static_cast<double>(codes.pixels.size());
  return out;
}

TactileImage transfer_noise(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference) {
  assert(reference.pixels.size() == simulated.pixels.size());
  assert(reference.pixels.size() == simulated_reference.pixels.size());
  TactileImage out{.image = ByteImage(reference.width, reference.height, reference.channels)};
  std::int64_t clipped = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    const long code =
        std::lround(reference.pixels[i] + (static_cast<double>(simulated.pixels[i]) - simulated_reference.pixels[i]));
    clipped += code < 0 || code > 255;
    out.image.pixels[i] = static_cast<std::uint8_t>(std::clamp(code, 0L, 255L));
  }
  out.clipped_fraction = static_cast<double>(clipped) / static_cast<double>(reference.pixels.size());
  return out;
}

TactileImage transfer_ratio(const ByteImage& reference, const FloatImage& simulated,
                            const FloatImage& simulated_reference, double exposure, const Response& response) {
  assert(reference.pixels.size() == simulated.pixels.size());
  assert(reference.pixels.size() == simulated_reference.pixels.size());
  constexpr double kSmallestDivisor = 1e-4;  // of full scale: below it a ratio says nothing
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
