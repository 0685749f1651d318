// Front faces for tests: a jittered square sheet, flat or domed.
#pragma once

#include <cmath>
#include <cstdint>

#include "stages/gel/press/measure/front_surface.h"

namespace tacipc {

/// A square of n × n cells of two triangles around the origin; inner vertices are moved by up to `jitter` of a cell in
/// a way that looks random and is always the same. `dome_radius_m` > 0 bends it down onto a sphere.
inline FrontSurface square_front(int n, double width_m, double jitter, Positions& positions,
                                 double dome_radius_m = 0.0) {
  FrontSurface front;
  positions.resize((n + 1) * (n + 1), 3);
  front.triangles.resize(2 * n * n, 3);
  std::uint32_t state = 12345;
  const auto offset = [&] {
    state = 1664525u * state + 1013904223u;
    return jitter * (static_cast<double>(state >> 8) / (1 << 24) - 0.5) * 2.0;
  };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && j > 0 && i < n && j < n;
      const double dx = offset(), dy = offset();
      const double x = width_m * ((i + (inner ? dx : 0.0)) / n - 0.5),
                   y = width_m * ((j + (inner ? dy : 0.0)) / n - 0.5);
      const double z =
          dome_radius_m > 0.0 ? std::sqrt(dome_radius_m * dome_radius_m - x * x - y * y) - dome_radius_m : 0.0;
      positions.row(j * (n + 1) + i) << x, y, z;
      front.vertices.push_back(j * (n + 1) + i);
    }
  }
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      front.triangles.row(2 * (j * n + i)) << a, b, c;
      front.triangles.row(2 * (j * n + i) + 1) << a, c, d;
    }
  }
  return front;
}

}  // namespace tacipc
