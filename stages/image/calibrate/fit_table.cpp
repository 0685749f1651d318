#include "stages/image/calibrate/fit_table.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/base/error.h"

namespace tacipc {
namespace {

constexpr int kTerms = SlopeTable::kTerms;

int bin_of(const SlopeTable& table, const ContactPixel& pixel) {
  return table.inclination_bin(std::hypot(pixel.slope_x, pixel.slope_y)) * table.bins +
         table.direction_bin(pixel.slope_x, pixel.slope_y);
}

/// Table of one ball, as released: a value and a position for every bin.
struct BallTable {
  std::vector<std::array<double, 3>> value;
  std::vector<std::array<double, kTerms>> terms;
};

BallTable table_of_ball(const std::vector<ContactPixel>& pixels, const SlopeTable& table, int width, int height) {
  const auto size = static_cast<std::size_t>(table.bins) * table.bins;
  std::array<std::vector<bool>, 3> has_value;
  for (auto& one : has_value) one.assign(size, false);
  std::vector<bool> has_place(size, false);
  std::vector<std::array<double, 3>> value(size);
  std::vector<std::array<double, kTerms>> terms(size);
  for (const ContactPixel& pixel : pixels) {
    if (!pixel.all_used()) continue;
    const auto bin = static_cast<std::size_t>(bin_of(table, pixel));
    value[bin] = pixel.target;
    terms[bin] = SlopeTable::terms(pixel.x, pixel.y, width, height);
    has_place[bin] = true;
    for (std::size_t c = 0; c < 3; ++c) has_value[c][bin] = pixel.target[c] != 0.0;  // 0 counts as missing
  }
  BallTable out{.value = value, .terms = terms};
  const auto place = nearest_marked(has_place, table.bins, false);
  for (std::size_t i = 0; i < size; ++i) out.terms[i] = terms[place[i]];
  for (std::size_t c = 0; c < 3; ++c) {
    if (std::ranges::find(has_value[c], true) == has_value[c].end()) continue;  // all values are 0
    const auto from = nearest_marked(has_value[c], table.bins, false);
    for (std::size_t i = 0; i < size; ++i) out.value[i][c] = value[from[i]][c];
  }
  return out;
}

SlopeTable released_table(const std::vector<std::vector<ContactPixel>>& balls, int width, int height, int bins) {
  SlopeTable table(bins);
  std::vector<BallTable> tables;
  for (const auto& pixels : balls)
    if (std::ranges::any_of(pixels, [](const ContactPixel& p) { return p.all_used(); }))
      tables.push_back(table_of_ball(pixels, table, width, height));
  if (tables.empty()) throw DataError("no ball has a pixel in its contact that is not clipped");
  const Eigen::Index rows = std::ssize(tables);
  Eigen::MatrixXd places(rows, kTerms), values(rows, 3);
  for (int i = 0; i < bins * bins; ++i) {
    for (Eigen::Index b = 0; b < rows; ++b) {
      const BallTable& ball = tables[b];
      for (Eigen::Index k = 0; k < kTerms; ++k) places(b, k) = ball.terms[i][k];
      for (Eigen::Index c = 0; c < 3; ++c) values(b, c) = ball.value[i][c];
    }
    const Eigen::MatrixXd weights = places.completeOrthogonalDecomposition().solve(values);
    double* out = table.at(i / bins, i % bins);
    for (Eigen::Index k = 0; k < kTerms; ++k)
      for (Eigen::Index c = 0; c < 3; ++c) out[3 * k + c] = weights(k, c);
  }
  return table;
}

/// Normal equations of a bin, Σ w wᵀ and Σ w ΔI, channel by channel.
struct BinEquations {
  std::array<Eigen::Matrix<double, kTerms, kTerms>, 3> gram;
  std::array<Eigen::Matrix<double, kTerms, 1>, 3> moment;

  BinEquations() {
    for (auto& g : gram) g.setZero();
    for (auto& m : moment) m.setZero();
  }
  void add(const BinEquations& other, double weight) {
    for (std::size_t c = 0; c < 3; ++c) {
      gram[c] += weight * other.gram[c];
      moment[c] += weight * other.moment[c];
    }
  }
  double pixels(std::size_t channel) const { return gram[channel](kTerms - 1, kTerms - 1); }
};

/// Applies a Gaussian over bins, cut at 4 σ. Inclination ends at its limits, direction is periodic.
std::vector<BinEquations> smoothed(const std::vector<BinEquations>& in, int bins, double sigma) {
  if (sigma == 0.0) return in;
  const int reach = static_cast<int>(std::ceil(4.0 * sigma)), around = bins - 1;
  const auto weight = [&](int i) { return std::exp(-0.5 * i * i / (sigma * sigma)); };
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * bins + j); };
  std::vector<BinEquations> rows(in.size()), out(in.size());
  for (int i = 0; i < bins; ++i)
    for (int d = -reach; d <= reach; ++d)
      if (i + d >= 0 && i + d < bins)
        for (int j = 0; j < around; ++j)
          if (in[at(i + d, j)].pixels(0) + in[at(i + d, j)].pixels(1) + in[at(i + d, j)].pixels(2) > 0.0)
            rows[at(i, j)].add(in[at(i + d, j)], weight(d));
  for (int i = 0; i < bins; ++i)
    for (int j = 0; j < around; ++j)
      for (int d = -reach; d <= reach; ++d)
        out[at(i, j)].add(rows[at(i, ((j + d) % around + around) % around)], weight(d));
  return out;
}

SlopeTable pooled_table(const std::vector<std::vector<ContactPixel>>& balls, int width, int height,
                        const TableFit& settings) {
  SlopeTable table(settings.bins);
  const int bins = settings.bins;
  std::vector<BinEquations> equations(static_cast<std::size_t>(bins) * bins);
  for (const auto& pixels : balls) {
    for (const ContactPixel& pixel : pixels) {
      auto bin = static_cast<std::size_t>(bin_of(table, pixel));
      // The last direction is only −x, where the first begins.
      if (bin % static_cast<std::size_t>(bins) == static_cast<std::size_t>(bins - 1))
        bin -= static_cast<std::size_t>(bins - 1);
      const auto terms = SlopeTable::terms(pixel.x, pixel.y, width, height);
      const Eigen::Map<const Eigen::Matrix<double, kTerms, 1>> w(terms.data());
      for (std::size_t c = 0; c < 3; ++c) {
        if (!pixel.used[c]) continue;
        equations[bin].gram[c] += w * w.transpose();
        equations[bin].moment[c] += pixel.target[c] * w;
      }
    }
  }
  equations = smoothed(equations, bins, settings.smoothing_bins);
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<bool> solved(equations.size(), false);
    for (std::size_t i = 0; i < equations.size(); ++i) {
      const double count = equations[i].pixels(c);
      if (count < 1e-9) continue;  // at or beyond the reach of the Gaussian
      Eigen::Matrix<double, kTerms, kTerms> system = equations[i].gram[c];
      for (int k = 0; k + 1 < kTerms; ++k) system(k, k) += settings.ridge * count;
      const Eigen::Matrix<double, kTerms, 1> weights = system.ldlt().solve(equations[i].moment[c]);
      if (!weights.allFinite()) continue;
      solved[i] = true;
      for (int k = 0; k < kTerms; ++k) table.weights[(i * kTerms + static_cast<std::size_t>(k)) * 3 + c] = weights[k];
    }
    if (std::ranges::find(solved, true) == solved.end())
      throw DataError("no ball has a pixel in its contact that is not clipped");
    const auto from = nearest_marked(solved, bins, true);
    for (std::size_t i = 0; i < equations.size(); ++i)
      for (std::size_t k = 0; k < kTerms; ++k)
        table.weights[(i * kTerms + k) * 3 + c] = table.weights[(from[i] * kTerms + k) * 3 + c];
  }
  return table;
}

}  // namespace

std::vector<std::size_t> nearest_marked(const std::vector<bool>& marked, int bins, bool around) {
  // First the nearest marked bin above or below in each direction, then the best of all directions.
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(i * bins + j); };
  std::vector<int> row(marked.size(), -1);
  for (int j = 0; j < bins; ++j) {
    for (int i = 0; i < bins; ++i)
      if (marked[at(i, j)]) row[at(i, j)] = i;
    for (int i = 1; i < bins; ++i)
      if (row[at(i, j)] < 0) row[at(i, j)] = row[at(i - 1, j)];
    for (int i = bins - 2; i >= 0; --i) {
      const int below = row[at(i + 1, j)];
      int& here = row[at(i, j)];
      if (below >= 0 && (here < 0 || std::abs(below - i) < std::abs(here - i))) here = below;
    }
  }
  std::vector<std::size_t> nearest(marked.size());
  for (int i = 0; i < bins; ++i) {
    for (int j = 0; j < bins; ++j) {
      int best = std::numeric_limits<int>::max();
      for (int k = 0; k < bins; ++k) {
        const int candidate = row[at(i, k)];
        if (candidate < 0) continue;
        const int apart = std::abs(k - j), across = around ? std::min(apart, bins - 1 - apart) : apart;
        const int distance = (candidate - i) * (candidate - i) + across * across;
        if (distance >= best) continue;
        best = distance;
        nearest[at(i, j)] = at(candidate, k);
      }
    }
  }
  return nearest;
}

SlopeTable fit_table(const std::vector<std::vector<ContactPixel>>& balls, int width_px, int height_px,
                     const TableFit& settings) {
  SlopeTable table = settings.pooled ? pooled_table(balls, width_px, height_px, settings)
                                     : released_table(balls, width_px, height_px, settings.bins);
  if (settings.flat_is_dark) std::fill(table.weights.begin(), table.weights.begin() + settings.bins * kTerms * 3, 0.0);
  return table;
}

}  // namespace tacipc
