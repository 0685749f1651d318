#include "stages/rival/mpm/height_map.h"

#include <algorithm>
#include <cmath>

#include "stages/rival/mpm/clough_tocher.h"

namespace tacipc {
namespace {

/// How far outside a triangle, in barycentric coordinates, a pixel on its edge may seem to lie by rounding.
constexpr double kBarycentricSlack = 1e-9;

}  // namespace

PixelLine::PixelLine(double center_m, double window_m, int pixels, PixelPlaces places)
    : first(center_m - 0.5 * window_m), step(window_m / pixels), count(pixels) {
  if (places == PixelPlaces::ends)
    step = pixels > 1 ? window_m / (pixels - 1) : 0.0;
  else
    first += 0.5 * step;
}

int PixelLine::from(double low) const { return step > 0.0 ? std::max(0, static_cast<int>(std::floor(pixel(low)))) : 0; }

int PixelLine::to(double high) const {
  return step > 0.0 ? static_cast<int>(std::min(count - 1.0, std::ceil(pixel(high)))) : count - 1;
}

FloatImage indentation_map(const GelLattice& lattice, const Positions& front_m, const Camera& camera,
                           PixelPlaces places) {
  const Triangles triangles = triangulate(lattice, front_m);
  const CloughTocher heights(front_m.leftCols<2>(), front_m.col(2), triangles);
  const PixelLine columns(camera.position_m.x(), camera.window_width_m, camera.width_px, places),
      rows(camera.position_m.y(), camera.window_height_m, camera.height_px, places);
  FloatImage map(camera.width_px, camera.height_px, 1);
  std::vector<bool> done(map.pixels.size(), false);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    Eigen::Matrix<double, 3, 2> corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = front_m.row(triangles(t, k)).head<2>();
    const Eigen::RowVector2d low = corners.colwise().minCoeff(), high = corners.colwise().maxCoeff();
    for (int y = rows.from(low.y()); y <= rows.to(high.y()); ++y) {
      for (int x = columns.from(low.x()); x <= columns.to(high.x()); ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * map.width + x;
        if (done[pixel]) continue;
        const Vector3 at = heights.barycentric(t, {columns.place(x), rows.place(y)});
        if (!(at.minCoeff() >= -kBarycentricSlack)) continue;
        map.pixels[pixel] = static_cast<float>(-heights.value(t, at));
        done[pixel] = true;
      }
    }
  }
  return map;
}

}  // namespace tacipc
