#include "common/sensor/dome_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/sensor/membrane_view.h"

namespace tacipc {
namespace {

/// From the plane up to elevation ε of a tangent: ∫ cos² ε and ∫ sin ε cos ε, of which the irradiance per azimuth is
/// n_z · across − A · along, A = n_x cos α + n_y sin α.
struct Elevation {
  double along, across;

  static Elevation of(double tangent) {
    const double square = tangent * tangent;
    return {0.5 * (std::atan(tangent) + tangent / (1.0 + square)), 0.5 * square / (1.0 + square)};
  }
  static Elevation zenith() { return {0.25 * std::numbers::pi, 0.5}; }
  double integral(double a, double nz) const { return nz * across - a * along; }
};

}  // namespace

double horizon_tangent(const MembraneView& view, int x, int y, double azimuth_rad) {
  if (view.width < 2 || view.height < 2) return -std::numeric_limits<double>::infinity();
  // One pixel of the undeformed front: parallax within a shadow's length is neglected.
  const double pixel = view.rest[1].x() - view.rest[0].x();
  const double tall = view.rest[static_cast<std::size_t>(view.width)].y() - view.rest[0].y();
  const double dx = std::cos(azimuth_rad), dy = std::sin(azimuth_rad) * pixel / tall;
  const double z = view.point[view.index(x, y)].z();
  double highest = -std::numeric_limits<double>::infinity();
  for (double s = 1.0;; s += std::max(1.0, s / 16.0)) {
    const double u = x + s * dx, v = y + s * dy;
    if (!(u >= 0.0 && v >= 0.0 && u <= view.width - 1 && v <= view.height - 1)) break;
    if (z - view.lowest_z < highest * s * pixel) break;  // no point farther away can be higher
    const int u0 = std::min(static_cast<int>(u), view.width - 2), v0 = std::min(static_cast<int>(v), view.height - 2);
    const double a = u - u0, b = v - v0;
    const std::size_t i = view.index(u0, v0), j = view.index(u0, v0 + 1);
    const double there = (1 - b) * ((1 - a) * view.point[i].z() + a * view.point[i + 1].z()) +
                         b * ((1 - a) * view.point[j].z() + a * view.point[j + 1].z());
    highest = std::max(highest, (z - there) / (s * pixel));
  }
  return highest;
}

void dome_irradiance(const DomeBins& bins, const MembraneView& view, int x, int y, const Vector3& normal, double* out) {
  constexpr int kDirectionsPerBin = 2;
  const int bands = bins.bands(), directions = kDirectionsPerBin * bins.azimuths;
  std::fill_n(out, bins.size(), 0.0);
  const double nz = normal.z();
  for (int d = 0; d < directions; ++d) {
    const double azimuth = 2.0 * std::numbers::pi * d / directions;
    const double a = normal.x() * std::cos(azimuth) + normal.y() * std::sin(azimuth);
    // Above the plane's own horizon too, which the march meets only one pixel away.
    const double facing = nz > 0.0 ? a / nz : std::numeric_limits<double>::infinity();
    const double horizon = std::max(horizon_tangent(view, x, y, azimuth), facing);
    const int bin = d / kDirectionsPerBin, next = (bin + 1) % bins.azimuths;
    const double share = static_cast<double>(d % kDirectionsPerBin) / kDirectionsPerBin;
    for (int band = 0; band < bands; ++band) {
      const double low = bins.elevation_tan[static_cast<std::size_t>(band)];
      const bool last = band + 1 == bands;
      const double high =
          last ? std::numeric_limits<double>::infinity() : bins.elevation_tan[static_cast<std::size_t>(band) + 1];
      const Elevation top = last ? Elevation::zenith() : Elevation::of(high);
      double value = Elevation::of(low).integral(0.0, 1.0) - top.integral(0.0, 1.0);
      if (horizon < high) value += top.integral(a, nz) - Elevation::of(std::max(low, horizon)).integral(a, nz);
      value *= 2.0 * std::numbers::pi / directions;
      out[bin * bands + band] += (1.0 - share) * value;
      out[next * bands + band] += share * value;
    }
  }
}

}  // namespace tacipc
