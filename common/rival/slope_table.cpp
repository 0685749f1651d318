#include "common/rival/slope_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/format/npy.h"

namespace tacipc {

SlopeTable::SlopeTable(int count) : bins(count), weights(static_cast<std::size_t>(count) * count * kTerms * 3, 0.0) {}

SlopeTable SlopeTable::read(const std::filesystem::path& path) {
  NpyArray array = read_npy(path);
  constexpr std::size_t kFewest = 2, kMost = 1000;
  if (array.shape.size() != 4 || array.shape[0] != array.shape[1] || array.shape[0] < kFewest ||
      array.shape[0] > kMost || array.shape[2] != kTerms || array.shape[3] != 3)
    throw DataError("{}: is no table of bins x bins x 6 x 3", path.string());
  SlopeTable table(static_cast<int>(array.shape[0]));
  table.weights = std::move(array.data);
  for (const double weight : table.weights)
    if (!std::isfinite(weight)) throw DataError("{}: a weight is not finite", path.string());
  return table;
}

void SlopeTable::write(const std::filesystem::path& path) const {
  const auto n = static_cast<std::size_t>(bins);
  write_npy(path, {n, n, std::size_t{kTerms}, 3}, weights.data());
}

int SlopeTable::inclination_bin(double slope) const {
  return std::min(static_cast<int>(std::atan(slope) / (0.5 * std::numbers::pi / (bins - 1))), bins - 1);
}

int SlopeTable::direction_bin(double slope_x, double slope_y) const {
  const double direction = slope_x == 0.0 && slope_y == 0.0 ? 0.0 : std::atan2(slope_y, slope_x);
  const double bin = (direction + std::numbers::pi) / (2.0 * std::numbers::pi / (bins - 1));
  return std::clamp(static_cast<int>(bin), 0, bins - 1);
}

std::array<double, SlopeTable::kTerms> SlopeTable::terms(int x, int y, int width, int height) {
  const double u = (2.0 * x + 1.0) / width - 1.0, v = (2.0 * y + 1.0) / height - 1.0;
  return {u * u, v * v, u * v, u, v, 1.0};
}

std::array<double, 3> SlopeTable::change(double slope_x, double slope_y,
                                         const std::array<double, kTerms>& terms) const {
  const double* w = at(inclination_bin(std::hypot(slope_x, slope_y)), direction_bin(slope_x, slope_y));
  std::array<double, 3> codes{};
  for (std::size_t k = 0; k < kTerms; ++k)
    for (std::size_t c = 0; c < 3; ++c) codes[c] += w[3 * k + c] * terms[k];
  return codes;
}

}  // namespace tacipc
