#include "common/benchmark/image_look.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "common/base/statistics.h"

namespace tacipc {
namespace {

constexpr int kColumns = 8, kRows = 6;  // numbers of cells
constexpr int kBlocks = 4;              // blocks per cell along each edge: their means contain little noise
constexpr double kPatternCodes = 2.0, kReliefCodes = 1.0, kLevelCodes = 1.5, kShade = 0.1, kLogarithm = 0.3;
constexpr double kMostNoiseCodes = 4.0;

/// Pixel range of one of several equal parts of an image, at least one pixel in each direction.
struct Cell {
  int left, top, right, bottom;
  double area() const { return static_cast<double>(right - left) * (bottom - top); }
};

std::vector<Cell> cells_of(const FloatImage& image, int columns, int rows) {
  std::vector<Cell> cells;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int left = column * image.width / columns, top = row * image.height / rows;
      cells.push_back({.left = left,
                       .top = top,
                       .right = std::max(left + 1, (column + 1) * image.width / columns),
                       .bottom = std::max(top + 1, (row + 1) * image.height / rows)});
    }
  return cells;
}

double mean_of(const FloatImage& image, const Cell& cell, int channel) {
  double sum = 0.0;
  for (int y = cell.top; y < cell.bottom; ++y)
    for (int x = cell.left; x < cell.right; ++x) sum += image.at(x, y, channel);
  return sum / cell.area();
}

/// Returns an image of means over blocks.
FloatImage blocks_of(const FloatImage& image) {
  FloatImage out(kColumns * kBlocks, kRows * kBlocks, 3);
  const std::vector<Cell> blocks = cells_of(image, out.width, out.height);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int c = 0; c < 3; ++c)
      out.pixels[3 * b + static_cast<std::size_t>(c)] = static_cast<float>(mean_of(image, blocks[b], c));
  return out;
}

/// Appends residuals of a cell's blocks from their best-fitting plane, 8-bit levels.
void append_relief(const FloatImage& blocks, const Cell& cell, int channel, std::vector<double>& relief) {
  const double mean = mean_of(blocks, cell, channel);
  const double x0 = 0.5 * (cell.left + cell.right - 1), y0 = 0.5 * (cell.top + cell.bottom - 1);
  double along_x = 0.0, along_y = 0.0, xx = 0.0, yy = 0.0;
  const auto each = [&](const auto& take) {
    for (int y = cell.top; y < cell.bottom; ++y)
      for (int x = cell.left; x < cell.right; ++x) take(x - x0, y - y0, blocks.at(x, y, channel) - mean);
  };
  each([&](double dx, double dy, double value) {
    along_x += value * dx;
    along_y += value * dy;
    xx += dx * dx;
    yy += dy * dy;
  });
  each([&](double dx, double dy, double value) { relief.push_back(value - dx * along_x / xx - dy * along_y / yy); });
}

Eigen::VectorXd pattern_of(const FloatImage& blocks, const std::vector<Cell>& cells) {
  Eigen::VectorXd pattern(3 * static_cast<Eigen::Index>(cells.size()));
  Eigen::Index k = 0;
  for (int c = 0; c < 3; ++c)
    for (const Cell& cell : cells) pattern[k++] = mean_of(blocks, cell, c) / kPatternCodes;
  return pattern;
}

Eigen::VectorXd relief_of(const FloatImage& blocks, const std::vector<Cell>& cells) {
  std::vector<double> relief;
  for (const Cell& cell : cells)
    for (int c = 0; c < 3; ++c) append_relief(blocks, cell, c, relief);
  return Eigen::Map<const Eigen::VectorXd>(relief.data(), static_cast<Eigen::Index>(relief.size())) / kReliefCodes;
}

/// Returns quartiles of the change over the cells, per channel, and subtracts the middle ones from the blocks.
Eigen::VectorXd take_level(FloatImage& blocks, const std::vector<Cell>& cells) {
  Eigen::VectorXd level(9);
  for (int c = 0; c < 3; ++c) {
    std::vector<double> means;
    for (const Cell& cell : cells) means.push_back(mean_of(blocks, cell, c));
    std::ranges::sort(means);
    const double middle = quantile(means, 0.5);
    level.segment<3>(3 * c) = Eigen::Vector3d(quantile(means, 0.25), middle, quantile(means, 0.75)) / kLevelCodes;
    for (std::size_t i = static_cast<std::size_t>(c); i < blocks.pixels.size(); i += 3)
      blocks.pixels[i] -= static_cast<float>(middle);
  }
  return level;
}

/// Subtracts noise from the change: three times the deviation of most blocks, but at most kMostNoise.
void take_noise(FloatImage& blocks) {
  constexpr double kDeviation = 1.4826;  // standard deviation over median of magnitudes, for a normal distribution
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<double> magnitudes;
    for (std::size_t i = c; i < blocks.pixels.size(); i += 3) magnitudes.push_back(std::abs(blocks.pixels[i]));
    const double noise = std::min(kMostNoiseCodes, 3.0 * kDeviation * median(std::move(magnitudes)));
    for (std::size_t i = c; i < blocks.pixels.size(); i += 3) {
      const double left = std::max(0.0, std::abs(blocks.pixels[i]) - noise);
      blocks.pixels[i] = static_cast<float>(std::copysign(left, blocks.pixels[i]));
    }
  }
}

/// Computes the numbers of the shading, in the order of the header.
/// \param pitch pixels from block to block
Eigen::VectorXd shading_of(const FloatImage& blocks, const Eigen::Vector2d& pitch, double change_codes) {
  Eigen::VectorXd shading = Eigen::VectorXd::Zero(13);
  using Channels = Eigen::Array<double, 3, Eigen::Dynamic>;
  const auto count = static_cast<Eigen::Index>(blocks.pixels.size() / 3);
  const Channels change =
      Eigen::Map<const Eigen::Array<float, 3, Eigen::Dynamic>>(blocks.pixels.data(), 3, count).cast<double>();
  const Eigen::ArrayXd energies = change.square().rowwise().sum();
  const double all = energies.sum();
  if (all <= 0.0) return shading;
  Eigen::Array2Xd place(2, count);
  for (Eigen::Index b = 0; b < count; ++b) {
    const Eigen::Index column = b % blocks.width, row = b / blocks.width;
    place.col(b) = pitch.array() * Eigen::Array2d(static_cast<double>(column), static_cast<double>(row));
  }
  const Eigen::Array<double, 1, Eigen::Dynamic> weights = change.square().colwise().sum() / all;
  place.colwise() -= (place.rowwise() * weights).rowwise().sum().eval();
  const double reach = std::sqrt(std::max(1.0, (place.square().colwise().sum() * weights).sum()));
  Eigen::Index k = 0;
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::Array<double, 1, Eigen::Dynamic> lighter = change.row(c) * change.row(c).abs();
    const Eigen::Array2d side =
        (place.rowwise() * lighter).rowwise().sum() / (reach * std::max(energies[c], 1e-12 * all));
    shading[k++] = side[0] / kShade;
    shading[k++] = side[1] / kShade;
  }
  for (Eigen::Index c = 0; c < 3; ++c) shading[k++] = energies[c] / all / kShade;
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::Index other = (c + 1) % 3;
    shading[k++] = (change.row(c) * change.row(other)).sum() /
                   std::sqrt(std::max(energies[c] * energies[other], 1e-24 * all * all)) / kShade;
  }
  shading[k] = std::log(change_codes) / kLogarithm;
  return shading;
}

}  // namespace

ImageLook look_of(const FloatImage& background) {
  assert(background.channels == 3);
  const FloatImage blocks = blocks_of(background);
  const std::vector<Cell> cells = cells_of(blocks, kColumns, kRows);
  return {.parts = {pattern_of(blocks, cells), relief_of(blocks, cells), Eigen::VectorXd(), Eigen::VectorXd()},
          .change_codes = 0.0};
}

ImageLook look_of(const FloatImage& background, const FloatImage& image) {
  assert(image.channels == 3 && background.width == image.width && background.height == image.height);
  ImageLook look = look_of(background);
  FloatImage change = image;
  for (std::size_t i = 0; i < change.pixels.size(); ++i) change.pixels[i] -= background.pixels[i];
  FloatImage blocks = blocks_of(change);
  look.parts[static_cast<std::size_t>(LookPart::level)] = take_level(blocks, cells_of(blocks, kColumns, kRows));
  take_noise(blocks);
  double squares = 0.0;
  for (const float change_of_block : blocks.pixels) squares += static_cast<double>(change_of_block) * change_of_block;
  look.change_codes = std::sqrt(squares / static_cast<double>(blocks.pixels.size()));
  const Eigen::Vector2d pitch(static_cast<double>(image.width) / blocks.width,
                              static_cast<double>(image.height) / blocks.height);
  look.parts[static_cast<std::size_t>(LookPart::shading)] = shading_of(blocks, pitch, look.change_codes);
  return look;
}

Eigen::VectorXd roughness_of(const Eigen::VectorXd& relief) {
  constexpr Eigen::Index kCells = kColumns * kRows;
  const Eigen::Index each = relief.size() / kCells;
  std::vector<double> rough;
  for (Eigen::Index k = 0; k < kCells; ++k)
    rough.push_back(relief.segment(k * each, each).norm() / std::sqrt(static_cast<double>(each)));
  const double middle = median(rough);
  return Eigen::Map<const Eigen::VectorXd>(rough.data(), kCells).array() - middle;
}

FloatImage turned(const FloatImage& image, const ImageTurn& turn) {
  FloatImage out(turn.transposed ? image.height : image.width, turn.transposed ? image.width : image.height,
                 image.channels);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const int u = turn.left_right ? out.width - 1 - x : x, v = turn.top_bottom ? out.height - 1 - y : y;
      for (int c = 0; c < image.channels; ++c)
        out.at(x, y, c) =
            image.at(turn.transposed ? v : u, turn.transposed ? u : v, turn.swapped && image.channels == 3 ? 2 - c : c);
    }
  return out;
}

}  // namespace tacipc
