#include "stages/render/develop.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "common/error.h"
#include "common/rng.h"

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

NoiseModel NoiseModel::read(ConfigReader& in) {
  return {.full_well_e = in.number("full_well_e", Range::positive()),
          .read_e = in.number("read_e", Range::non_negative()),
          .seed = in.integer("seed", 0)};
}

double code_of(double v, const std::string& curve) {
  if (curve == "linear") return 255.0 * v;
  return 255.0 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055);
}

double solve_exposure(const FloatImage& linear, const Response& response) {
  const float brightest = *std::max_element(linear.pixels.begin(), linear.pixels.end());
  if (!(brightest > 0.0f)) throw DataError("no light reaches the front face: check the positions of the LEDs");
  const double wanted = response.mean_level * 255.0 * static_cast<double>(linear.pixels.size());
  const auto total = [&](double exposure) {
    return sum_rows(linear.height, row_length(linear), [&](std::size_t i) {
      return std::min(code_of(exposure * linear.pixels[i], response.curve), 255.0);
    });
  };
  // At `low` even the brightest value is below the wanted mean; `high` doubles until the mean is reached.
  double low = std::log(1e-6 / brightest), high = std::log(1.0 / brightest);
  for (int doublings = 0; total(std::exp(high)) < wanted; ++doublings) {
    if (doublings == 60) {
      throw DataError("no exposure gives the mean level {}: too much of the image is black", response.mean_level);
    }
    high += std::log(2.0);
  }
  for (double middle = 0.5 * (low + high); low < middle && middle < high; middle = 0.5 * (low + high)) {
    (total(std::exp(middle)) < wanted ? low : high) = middle;
  }
  return std::exp(high);
}

FloatImage encode(const FloatImage& linear, double exposure, const Response& response) {
  FloatImage codes(linear.width, linear.height, linear.channels);
  const std::size_t length = row_length(linear);
  tbb::parallel_for(0, linear.height, [&](int y) {
    const auto row = static_cast<std::size_t>(y);
    for (std::size_t i = row * length; i < (row + 1) * length; ++i) {
      codes.pixels[i] = static_cast<float>(code_of(exposure * linear.pixels[i], response.curve));
    }
  });
  return codes;
}

ByteImage synthetic_reference(const FloatImage& linear, double exposure, const Response& response,
                              const NoiseModel& noise) {
  constexpr std::uint64_t kNoiseStream = 1;
  ByteImage image(linear.width, linear.height, linear.channels);
  for (std::size_t i = 0; i < linear.pixels.size(); ++i) {
    const double electrons = noise.full_well_e * exposure * linear.pixels[i];
    const double deviation = std::sqrt(electrons + noise.read_e * noise.read_e);
    const double noisy = electrons + deviation * random_normal(static_cast<std::uint64_t>(noise.seed), kNoiseStream, i);
    const double v = std::clamp(noisy / noise.full_well_e, 0.0, 1.0);
    image.pixels[i] = static_cast<std::uint8_t>(std::lround(code_of(v, response.curve)));
  }
  return image;
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

}  // namespace tacipc
