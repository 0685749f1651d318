#include "tests/common/optics/test_surfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tacipc {

Membrane height_field(double half_width, double half_height, double spacing,
                      const std::function<double(double, double)>& z) {
  const int nx = std::max(1, static_cast<int>(std::lround(2.0 * half_width / spacing)));
  const int ny = std::max(1, static_cast<int>(std::lround(2.0 * half_height / spacing)));
  const int corners = (nx + 1) * (ny + 1);
  Positions positions(corners + nx * ny, 3);
  const auto place = [&](int row, double i, double j) {
    const double x = half_width * (2.0 * i / nx - 1.0), y = half_height * (2.0 * j / ny - 1.0);
    positions.row(row) << x, y, z(x, y);
  };
  Triangles triangles(4 * nx * ny, 3);
  for (int j = 0; j <= ny; ++j) {
    for (int i = 0; i <= nx; ++i) place(j * (nx + 1) + i, i, j);
  }
  int f = 0;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const int centre = corners + j * nx + i, a = j * (nx + 1) + i, b = a + 1, c = b + nx + 1, d = a + nx + 1;
      place(centre, i + 0.5, j + 0.5);
      triangles.row(f++) << a, b, centre;
      triangles.row(f++) << b, c, centre;
      triangles.row(f++) << c, d, centre;
      triangles.row(f++) << d, a, centre;
    }
  }
  Positions rest = positions;
  rest.col(2).setZero();
  return make_membrane(positions, rest, triangles);
}

Membrane step_of_1mm() {
  Positions positions(12, 3);
  positions << -4, -4, 0, 0, -4, 0, 0, 4, 0, -4, 4, 0,  // floor
      0, -4, -1, 4, -4, -1, 4, 4, -1, 0, 4, -1,         // plateau
      0, -4, 0, 0, -4, -1, 0, 4, -1, 0, 4, 0;           // wall, facing −x from inside
  positions *= kMm;
  Triangles triangles(6, 3);
  triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 8, 9, 10, 8, 10, 11;
  return make_membrane(positions, positions, triangles);
}

Sensor plain_sensor(int width_px, int height_px) {
  Sensor sensor;
  sensor.name = "plain";
  sensor.gel = {.outline = GelShape::Outline::rectangle, .width_m = 8e-3, .height_m = 8e-3, .thickness_m = 2e-3};
  sensor.stack.gel_thickness_m = 2e-3;
  sensor.coating.albedo = {1.0, 1.0, 1.0};
  sensor.camera = {.position_m = {0.0, 0.0, -12.0 * kMm},
                   .width_px = width_px,
                   .height_px = height_px,
                   .window_width_m = 4.0 * kMm,
                   .window_height_m = 3.0 * kMm};
  sensor.response = {.mean_level = 0.5, .curve = "linear"};
  return sensor;
}

Led point_light(const Vector3& position_m) {
  return {.position_m = position_m, .rgb = {1.0, 1.0, 1.0}, .size_m = {0.0, 0.0}, .emission = Emission::isotropic};
}

double largest_difference(const FloatImage& a, const FloatImage& b) {
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  double most = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    most = std::max(most, std::abs(static_cast<double>(a.pixels[i]) - b.pixels[i]));
  }
  return most;
}

double ball_press(double x, double y) {
  constexpr double kRadius = 3.0 * kMm, kDepth = 1.0 * kMm;
  const double r = std::hypot(x, y);
  // On the ball down to where it stands 40° steep, then an exponential with the same height and slope.
  const double edge = kRadius * std::sin(0.698), cosine = std::cos(0.698);
  if (r < edge) return -(kDepth - (kRadius - std::sqrt(kRadius * kRadius - r * r)));
  const double height = kDepth - kRadius * (1.0 - cosine), slope = std::tan(0.698);
  return -height * std::exp(-(r - edge) * slope / height);
}

}  // namespace tacipc
