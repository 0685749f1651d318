#include "common/sensor/dome_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/sensor/membrane_view.h"

namespace tacipc {
namespace {

constexpr int kDirectionsPerBin = 2;
constexpr int kBlockPx = 16;
constexpr double kNoHorizon = -std::numeric_limits<double>::infinity();
constexpr double kLeastHorizon = 0.005;

/// Size of one pixel of the undeformed front: parallax within a shadow's length is neglected.
double pixel_width(const MembraneView& view) { return view.rest[1].x() - view.rest[0].x(); }
double pixel_height(const MembraneView& view) { return view.rest[view.width].y() - view.rest[0].y(); }

/// Marches by (dx, dy) pixels per step over heights `z_of(i)`. Returns the largest tangent on the path, or `highest` if
/// that is larger.
/// \param lowest_z lower bound of all points ahead of pixel (u, v)
template <typename Height, typename Lowest>
double march(const MembraneView& view, const Height& z_of, int x, int y, double dx, double dy, double pixel,
             double highest, const Lowest& lowest_z) {
  const double z = z_of(view.index(x, y));
  if (z - lowest_z(x, y) <= highest * pixel) return highest;
  for (double s = 1.0;; s += std::max(1.0, s / 16.0)) {
    const double u = x + s * dx, v = y + s * dy;
    if (!(u >= 0.0 && v >= 0.0 && u <= view.width - 1 && v <= view.height - 1)) return highest;
    const int u0 = std::min(static_cast<int>(u), view.width - 2), v0 = std::min(static_cast<int>(v), view.height - 2);
    if (z - lowest_z(u0, v0) <= highest * s * pixel) return highest;  // no point farther away can be higher
    const double a = u - u0, b = v - v0;
    const std::size_t i = view.index(u0, v0), j = view.index(u0, v0 + 1);
    const double there = (1 - b) * ((1 - a) * z_of(i) + a * z_of(i + 1)) + b * ((1 - a) * z_of(j) + a * z_of(j + 1));
    highest = std::max(highest, (z - there) / (s * pixel));
  }
}

/// Returns the smallest z of each block of pixels and its eight neighbours.
std::vector<double> lowest_around(const MembraneView& view, int wide, int high) {
  std::vector<double> own(static_cast<std::size_t>(wide) * high, 0.0);
  const auto at = [&](int i, int j) { return static_cast<std::size_t>(j) * wide + i; };
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      double& z = own[at(x / kBlockPx, y / kBlockPx)];
      z = std::min(z, view.point[view.index(x, y)].z());
    }
  std::vector<double> around = own;
  for (int j = 0; j < high; ++j)
    for (int i = 0; i < wide; ++i)
      for (int v = std::max(j - 1, 0); v <= std::min(j + 1, high - 1); ++v)
        for (int u = std::max(i - 1, 0); u <= std::min(i + 1, wide - 1); ++u)
          around[at(i, j)] = std::min(around[at(i, j)], own[at(u, v)]);
  return around;
}

/// Returns the smallest z on paths from any pixel of each block. At every half block along the path from the block's
/// middle, paths from its other pixels are within three quarters of a block: in the block at that point or one of its
/// neighbours.
std::vector<double> lowest_on_the_way(const std::vector<double>& around, int wide, int high, double dx, double dy) {
  std::vector<double> out(around.size());
  for (int j = 0; j < high; ++j)
    for (int i = 0; i < wide; ++i) {
      double lowest = 0.0;
      for (double s = 0.0;; s += 0.5) {  // in units of blocks
        const double u = i + 0.5 + s * dx, v = j + 0.5 + s * dy;
        if (!(u > -1.0 && v > -1.0 && u < wide + 1.0 && v < high + 1.0)) break;
        const int k = std::clamp(static_cast<int>(std::floor(u)), 0, wide - 1),
                  l = std::clamp(static_cast<int>(std::floor(v)), 0, high - 1);
        lowest = std::min(lowest, around[l * wide + k]);
      }
      out[j * wide + i] = lowest;
    }
  return out;
}

}  // namespace

double horizon_tangent(const MembraneView& view, int x, int y, double azimuth_rad) {
  if (view.width < 2 || view.height < 2) return kNoHorizon;
  const double pixel = pixel_width(view), dy = std::sin(azimuth_rad) * pixel / pixel_height(view);
  return march(
      view, [&](std::size_t i) { return view.point[i].z(); }, x, y, std::cos(azimuth_rad), dy, pixel, kNoHorizon,
      [&](int, int) { return view.lowest_z; });
}

DomeIrradiance::Elevation DomeIrradiance::Elevation::of(double tangent) {
  const double square = tangent * tangent;
  return {0.5 * (std::atan(tangent) + tangent / (1.0 + square)), 0.5 * square / (1.0 + square)};
}

DomeIrradiance::DomeIrradiance(const DomeBins& bins, const MembraneView& view) : bins_(bins), view_(&view) {
  for (const Vector3& point : view.point) z_.push_back(point.z());
  for (const double tangent : bins.elevation_tan) edges_.push_back(Elevation::of(tangent));
  edges_.push_back({0.25 * std::numbers::pi, 0.5});
  for (std::size_t k = 0; k + 1 < edges_.size(); ++k)
    bands_.push_back({edges_[k + 1].along - edges_[k].along, edges_[k + 1].across - edges_[k].across});
  const bool alone = view.width < 2 || view.height < 2;  // a single row or column of pixels casts no shadow
  const int wide = (view.width + kBlockPx - 1) / kBlockPx, high = (view.height + kBlockPx - 1) / kBlockPx;
  const std::vector<double> around = lowest_around(view, wide, high);
  blocks_wide_ = wide;
  pixel_m_ = alone ? 1.0 : pixel_width(view);
  const int count = kDirectionsPerBin * bins.azimuths;
  for (int d = 0; d < count; ++d) {
    const double azimuth = 2.0 * std::numbers::pi * d / count;
    Direction direction;
    // Exactly along rows and columns, so that rounding does not move the march off the image's outermost line.
    const auto exact = [](double value) { return std::abs(value) < 1e-12 ? 0.0 : value; };
    direction.cosine = exact(std::cos(azimuth));
    direction.sine = exact(std::sin(azimuth));
    direction.dx = direction.cosine;
    direction.dy = alone ? 0.0 : direction.sine * pixel_m_ / pixel_height(view);
    direction.lowest = lowest_on_the_way(around, wide, high, direction.dx, direction.dy);
    for (auto row = direction.lowest.begin(); row != direction.lowest.end(); row += wide)
      direction.lowest_of_row.push_back(*std::min_element(row, row + wide));
    directions_.push_back(std::move(direction));
  }
}

template <typename Horizon>
void DomeIrradiance::integrate(const Vector3& normal, const Horizon& horizon, double* out) const {
  const std::size_t bands = bands_.size();
  const int count = static_cast<int>(directions_.size());
  std::fill_n(out, bins_.size(), 0.0);
  const double nz = normal.z(), width = 2.0 * std::numbers::pi / count;
  std::vector<double> lit(bands);
  for (int d = 0; d < count; ++d) {
    const Direction& direction = directions_[d];
    const double a = normal.x() * direction.cosine + normal.y() * direction.sine;
    // The horizon of the tangent plane itself also counts; the march meets it only one pixel away.
    const double facing = nz > 0.0 ? a / nz : std::numeric_limits<double>::infinity();
    const double tangent = std::max(facing, horizon(d, std::max(facing, kLeastHorizon)));
    // The first `hidden` bands begin below the horizon; only the last of them may be partly visible.
    std::size_t hidden = 0;
    while (hidden < bands && tangent > bins_.elevation_tan[hidden]) ++hidden;
    for (std::size_t k = 0; k < bands; ++k) lit[k] = k < hidden ? 0.0 : bands_[k].integral(a, nz);
    if (hidden > 0 && std::isfinite(tangent))
      lit[hidden - 1] = edges_[hidden].integral(a, nz) - Elevation::of(tangent).integral(a, nz);
    const int bin = d / kDirectionsPerBin, next = (bin + 1) % bins_.azimuths;
    const double share = static_cast<double>(d % kDirectionsPerBin) / kDirectionsPerBin;
    const auto add = [&](int to, double part) {
      double* sum = out + static_cast<std::size_t>(to) * bands;
      for (std::size_t k = 0; k < bands; ++k) sum[k] += part * (lit[k] - bands_[k].across);
    };
    add(bin, (1.0 - share) * width);
    if (share > 0.0) add(next, share * width);
  }
}

void DomeIrradiance::at(int x, int y, const Vector3& normal, double* out) const {
  const auto marched = [&](int d, double least) {
    const Direction& direction = directions_[d];
    const double highest = march(
        *view_, [&](std::size_t i) { return z_[i]; }, x, y, direction.dx, direction.dy, pixel_m_, least,
        [&](int u, int v) { return direction.lowest[v / kBlockPx * blocks_wide_ + u / kBlockPx]; });
    return highest > least ? highest : kNoHorizon;
  };
  integrate(normal, marched, out);
}

std::vector<double> DomeIrradiance::row_horizons(int y) const {
  const int width = view_->width, height = view_->height;
  std::vector<double> out(directions_.size() * static_cast<std::size_t>(width), kLeastHorizon);
  const double* z = &z_[view_->index(0, y)];
  const double top = *std::max_element(z, z + width);
  for (std::size_t d = 0; d < directions_.size() && height > 1; ++d) {
    const Direction& direction = directions_[d];
    double* horizon = &out[d * static_cast<std::size_t>(width)];
    for (double s = 1.0;; s += std::max(1.0, s / 16.0)) {
      const double u = s * direction.dx, v = y + s * direction.dy;
      if (!(v >= 0.0 && v <= height - 1)) break;
      const int u0 = static_cast<int>(std::floor(u)), v0 = std::min(static_cast<int>(v), height - 2);
      const double a = u - u0, b = v - v0, inverse = 1.0 / (s * pixel_m_);
      const bool between = a > 0.0;  // interpolate between two columns
      const int first = std::max(0, -u0), last = std::min(width, width - u0 - (between ? 1 : 0));
      if (first >= last) break;
      if (top - direction.lowest_of_row[v0 / kBlockPx] <= kLeastHorizon * s * pixel_m_) break;
      const double *above = &z_[view_->index(0, v0)] + u0, *below = &z_[view_->index(0, v0 + 1)] + u0;
      if (between)
        for (int x = first; x < last; ++x) {
          const double there =
              (1 - b) * ((1 - a) * above[x] + a * above[x + 1]) + b * ((1 - a) * below[x] + a * below[x + 1]);
          horizon[x] = std::max(horizon[x], (z[x] - there) * inverse);
        }
      else
        for (int x = first; x < last; ++x)
          horizon[x] = std::max(horizon[x], (z[x] - ((1 - b) * above[x] + b * below[x])) * inverse);
    }
  }
  for (double& tangent : out)
    if (tangent == kLeastHorizon) tangent = kNoHorizon;
  return out;
}

void DomeIrradiance::at(int x, const std::vector<double>& row_horizons, const Vector3& normal, double* out) const {
  const auto width = static_cast<std::size_t>(view_->width);
  integrate(
      normal, [&](int d, double) { return row_horizons[static_cast<std::size_t>(d) * width + x]; }, out);
}

}  // namespace tacipc
