#include "stages/rival/baseline/taxim_table.h"

#include <array>
#include <cmath>
#include <string>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/format/npy.h"
#include "common/mesh/zip_parts.h"

namespace tacipc {
namespace {

constexpr std::array<const char*, 3> kOfChannel{"grad_b", "grad_g", "grad_r"};  // arrays for red, green, blue

/// Weights of x², y², x y, x, y, 1 from those of X and Y, with X = a x + b and Y = c y + d.
std::array<double, SlopeTable::kTerms> of_unit_square(const double* w, int width, int height) {
  const double a = 0.5 * width, b = 0.5 * (width - 1), c = 0.5 * height, d = 0.5 * (height - 1);
  return {w[0] * a * a,
          w[1] * c * c,
          w[2] * a * c,
          a * (2.0 * w[0] * b + w[2] * d + w[3]),
          c * (2.0 * w[1] * d + w[2] * b + w[4]),
          w[0] * b * b + w[1] * d * d + w[2] * b * d + w[3] * b + w[4] * d + w[5]};
}

}  // namespace

SlopeTable read_taxim_table(const std::filesystem::path& path, int width, int height) {
  const std::string bytes = read_file(path);
  ZipParts archive(bytes, path.string());
  std::array<NpyArray, 3> channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::string part = "/" + std::string(kOfChannel[c]) + ".npy";
    channels[c] = read_npy_bytes(archive.read({part}).front(), path.string() + ": " + kOfChannel[c]);
  }
  const std::vector<std::size_t>& shape = channels[0].shape;
  constexpr std::size_t kFewest = 2, kMost = 1000;
  if (shape.size() != 3 || shape[0] != shape[1] || shape[0] < kFewest || shape[0] > kMost ||
      shape[2] != SlopeTable::kTerms)
    throw DataError("{}: {} is no table of bins x bins x 6", path.string(), kOfChannel[0]);
  SlopeTable table(static_cast<int>(shape[0]));
  const std::size_t cells = shape[0] * shape[1];
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (channels[c].shape != shape)
      throw DataError("{}: {} has another shape than {}", path.string(), kOfChannel[c], kOfChannel[0]);
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const auto weights = of_unit_square(channels[c].data.data() + SlopeTable::kTerms * cell, width, height);
      for (std::size_t k = 0; k < weights.size(); ++k) {
        if (!std::isfinite(weights[k])) throw DataError("{}: {}: a weight is not finite", path.string(), kOfChannel[c]);
        table.weights[(SlopeTable::kTerms * cell + k) * channels.size() + c] = weights[k];
      }
    }
  }
  return table;
}

}  // namespace tacipc
