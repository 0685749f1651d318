#include "common/sensor/dome_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <vector>

#include "common/sensor/membrane_view.h"
#include "tests/common/sensor/pinhole.h"

namespace tacipc {
namespace dome_light_test {

/// 121 × 81 pixels of 0.05 mm, seen from far away: no parallax.
MembraneView view_of(const std::function<double(double, double)>& indentation) {
  Sensor sensor;
  sensor.camera = {.position_m = {0, 0, -50.0},
                   .width_px = 121,
                   .height_px = 81,
                   .window_width_m = 121 * 0.05e-3,
                   .window_height_m = 81 * 0.05e-3};
  FloatImage map(121, 81, 1);
  const Pinhole pinhole(sensor.camera);
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      const Vector3 p = pinhole.plane_point(x, y);
      map.at(x, y, 0) = static_cast<float>(indentation(p.x(), p.y()));
    }
  return view_height_map(map, sensor);
}

/// Flat at x < 1 mm, 0.6 mm into the gel beyond.
MembraneView step() {
  return view_of([](double x, double) { return x > 1e-3 ? 0.6e-3 : 0.0; });
}
constexpr int kMiddleX = 60, kMiddleY = 40;  // x = y = 0
constexpr double kPixelMm = 0.05;

/// Of the pixel in the middle.
void irradiance(const DomeBins& bins, const MembraneView& view, std::vector<double>& out) {
  DomeIrradiance(bins, view).at(kMiddleX, kMiddleY, view.normal[view.index(kMiddleX, kMiddleY)], out.data());
}

TEST(HorizonTangent, OfAStepIsItsHeightOverItsDistance) {
  const MembraneView view = step();
  for (const double distance_mm : {0.4, 1.0, 2.5}) {
    const int x = kMiddleX + static_cast<int>(std::lround((1.0 - distance_mm) / kPixelMm));
    const double expected = 0.6 / distance_mm;
    // The wall is found to within a pixel or 1/16 of the way.
    const double tolerance = expected * (kPixelMm / distance_mm + 1.0 / 16.0);
    EXPECT_NEAR(horizon_tangent(view, x, kMiddleY, 0.0), expected, tolerance) << distance_mm;
    EXPECT_NEAR(horizon_tangent(view, x, kMiddleY, std::numbers::pi), 0.0, 1e-6) << distance_mm;
    // Obliquely the way is longer by 1 / cos.
    EXPECT_NEAR(horizon_tangent(view, x, kMiddleY, 0.5), expected * std::cos(0.5), tolerance) << distance_mm;
  }
}

TEST(DomeIrradiance, OfAFlatFrontDoesNotChange) {
  const DomeBins bins{.azimuths = 6, .elevation_tan = {0.0, 0.5, 1.5}};
  std::vector<double> out(static_cast<std::size_t>(bins.size()), 1.0);
  irradiance(bins, view_of([](double, double) { return 0.0; }), out);
  for (const double value : out) EXPECT_NEAR(value, 0.0, 1e-12);
}

TEST(DomeIrradiance, OfASlopeUnderUniformLightIsThatOfTheVisiblePart) {
  // Radiance 1 from the whole half space lights a plane tilted by θ with π (1 + cos θ) / 2.
  const DomeBins bins{.azimuths = 12, .elevation_tan = {0.0, 0.2, 0.5, 1.0}};
  const double slope = 0.3, cosine = 1.0 / std::hypot(1.0, slope);
  std::vector<double> out(static_cast<std::size_t>(bins.size()));
  irradiance(bins, view_of([&](double x, double) { return 1e-3 + slope * x; }), out);
  EXPECT_NEAR(std::accumulate(out.begin(), out.end(), 0.0), 0.5 * std::numbers::pi * (cosine - 1.0), 2e-3);
  // The front rises into the gel along x: light from there is lost, and gained from the other side.
  EXPECT_LT(out[1], 0.0);
  EXPECT_GT(out[static_cast<std::size_t>(6 * bins.bands() + 1)], 0.0);
}

TEST(DomeIrradiance, BesideAStepLosesWhatLiesBelowItsEdge) {
  const MembraneView view = step();
  const DomeBins bins{.azimuths = 4, .elevation_tan = {0.0, 0.2, 0.8}};
  std::vector<double> out(static_cast<std::size_t>(bins.size()));
  irradiance(bins, view, out);
  // Towards +x the horizon is at the tangent 0.6 cos α; the hat's two other directions, at 45°, count half.
  const auto lost = [](double low, double high) {
    const auto share = [](double t) { return 0.5 * t * t / (1.0 + t * t); };
    return share(high) - share(low);
  };
  const double each = 2.0 * std::numbers::pi / 8.0, ahead = horizon_tangent(view, kMiddleX, kMiddleY, 0.0),
               aside = horizon_tangent(view, kMiddleX, kMiddleY, std::numbers::pi / 4.0);
  EXPECT_NEAR(ahead, 0.6, 0.06);
  EXPECT_NEAR(aside, 0.6 * std::cos(std::numbers::pi / 4.0), 0.06);
  EXPECT_NEAR(out[0], -each * 2.0 * lost(0.0, 0.2), 1e-9);
  EXPECT_NEAR(out[1], -each * (lost(0.2, ahead) + lost(0.2, aside)), 1e-6);
  EXPECT_NEAR(out[2], 0.0, 1e-12);         // above the edge nothing is hidden
  EXPECT_NEAR(out[2 * 3 + 0], 0.0, 1e-6);  // nor from behind
}

/// The formula with the whole march in every direction, numerically over elevations.
std::vector<double> marched(const DomeBins& bins, const MembraneView& view, int x, int y) {
  const Vector3& n = view.normal[view.index(x, y)];
  const int directions = 2 * bins.azimuths;
  std::vector<double> out(static_cast<std::size_t>(bins.size()), 0.0);
  for (int d = 0; d < directions; ++d) {
    const double azimuth = 2.0 * std::numbers::pi * d / directions, horizon = horizon_tangent(view, x, y, azimuth);
    for (int band = 0; band < bins.bands(); ++band) {
      const auto k = static_cast<std::size_t>(band);
      const double from = std::atan(bins.elevation_tan[k]);
      const double to = band + 1 < bins.bands() ? std::atan(bins.elevation_tan[k + 1]) : 0.5 * std::numbers::pi;
      constexpr int kSteps = 2000;
      double sum = 0.0;
      for (int i = 0; i < kSteps; ++i) {
        const double e = from + (to - from) * (i + 0.5) / kSteps;
        const Vector3 w(std::cos(e) * std::cos(azimuth), std::cos(e) * std::sin(azimuth), -std::sin(e));
        const double lit = std::tan(e) > horizon ? std::max(-n.dot(w), 0.0) : 0.0;
        sum += (lit - std::sin(e)) * std::cos(e) * (to - from) / kSteps;
      }
      sum *= 2.0 * std::numbers::pi / directions;
      const int bin = d / 2, next = (bin + 1) % bins.azimuths;
      const double share = 0.5 * (d % 2);
      out[static_cast<std::size_t>(bin * bins.bands() + band)] += (1.0 - share) * sum;
      out[static_cast<std::size_t>(next * bins.bands() + band)] += share * sum;
    }
  }
  return out;
}

// Three bumps, one with steep walls and one in a corner, in a front that waves a little: what blocks of pixels rule out
// is nowhere missed.
TEST(DomeIrradiance, IsThatOfTheWholeMarchAtEveryPixel) {
  const auto bump = [](double x, double y, double radius, double depth) {
    return depth * std::exp(-std::pow((x * x + y * y) / (radius * radius), 3.0));
  };
  const MembraneView view = view_of([&](double x, double y) {
    return 3e-6 * std::sin(2e3 * x + 1e3 * y) + bump(x - 1.5e-3, y - 0.4e-3, 0.5e-3, 0.7e-3) +
           bump(x + 1.2e-3, y + 0.7e-3, 0.4e-3, 0.2e-3) + bump(x - 2.9e-3, y - 1.9e-3, 0.4e-3, 0.5e-3);
  });
  const DomeBins bins{.azimuths = 6, .elevation_tan = {0.0, 0.15, 0.5}};
  const DomeIrradiance dome(bins, view);
  std::vector<double> out(static_cast<std::size_t>(bins.size())), of_row = out;
  int shaded = 0;
  for (const int y : {0, 1, 6, 11, 20, 29, 38, 41, 46, 51, 56, 63, 71, 79, 80}) {
    const std::vector<double> row = dome.row_horizons(y);
    for (const int x : {0, 1, 4, 15, 26, 37, 48, 59, 70, 77, 80, 84, 88, 92, 97, 103, 110, 118, 119, 120}) {
      dome.at(x, y, view.normal[view.index(x, y)], out.data());
      const std::vector<double> expected = marched(bins, view, x, y);
      // What horizons below 0.005 hide, and the numerical integral's steps at the others.
      const Vector3& n = view.normal[view.index(x, y)];
      const double tolerance = 4e-4 + 0.005 * std::hypot(n.x(), n.y());
      for (std::size_t k = 0; k < out.size(); ++k)
        ASSERT_NEAR(out[k], expected[k], tolerance) << x << " " << y << " " << k;
      dome.at(x, row, view.normal[view.index(x, y)], of_row.data());
      for (std::size_t k = 0; k < out.size(); ++k) ASSERT_NEAR(of_row[k], out[k], 1e-7) << x << " " << y << " " << k;
      shaded += expected[0] < -0.005 ? 1 : 0;
    }
  }
  EXPECT_GT(shaded, 15);
}

}  // namespace dome_light_test
}  // namespace tacipc
