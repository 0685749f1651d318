#include "stages/rival/mpm/height_map.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/error.h"
#include "common/sensor/camera_model.h"
#include "stages/rival/mpm/clough_tocher.h"

namespace tacipc {
namespace {

/// Tolerance, in barycentric coordinates, for a pixel on an edge that rounding puts outside the triangle.
constexpr double kBarycentricSlack = 1e-9;

constexpr int kHalvings = 24;  // bisections of half a pixel's distance along a ray: below 1e-8 of it

/// Surface interpolated between the pixels of its map.
class Surface {
 public:
  Surface(const FloatImage& map, const Camera& camera, PixelPlaces places)
      : map_(map),
        columns_(camera.position_m.x(), camera.window_width_m, map.width, places),
        rows_(camera.position_m.y(), camera.window_height_m, map.height, places) {}

  double indentation(double x, double y) const {
    const double u = std::clamp(columns_.pixel(x), 0.0, map_.width - 1.0);
    const double v = std::clamp(rows_.pixel(y), 0.0, map_.height - 1.0);
    const int i = std::min(static_cast<int>(u), std::max(0, map_.width - 2));
    const int j = std::min(static_cast<int>(v), std::max(0, map_.height - 2));
    const int k = std::min(i + 1, map_.width - 1), l = std::min(j + 1, map_.height - 1);
    const double s = u - i, t = v - j;
    return (1.0 - t) * ((1.0 - s) * map_.at(i, j, 0) + s * map_.at(k, j, 0)) +
           t * ((1.0 - s) * map_.at(i, l, 0) + s * map_.at(k, l, 0));
  }
  double pixel_m() const { return std::min(columns_.step, rows_.step); }

 private:
  const FloatImage& map_;
  PixelLine columns_, rows_;
};

}  // namespace

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

FloatImage seen_along_rays(const FloatImage& from_above, const Sensor& sensor, PixelPlaces places) {
  assert(from_above.width == sensor.camera.width_px && from_above.height == sensor.camera.height_px);
  const Surface surface(from_above, sensor.camera, places);
  const CameraModel rays(sensor.camera, sensor.stack);
  const double deepest = std::max(0.0, double{*std::ranges::max_element(from_above.pixels)});
  const double highest = std::min(0.0, double{*std::ranges::min_element(from_above.pixels)});
  FloatImage seen(from_above.width, from_above.height, 1);
  for (int y = 0; y < seen.height; ++y) {
    for (int x = 0; x < seen.width; ++x) {
      const auto ray = rays.ray(x + 0.5, y + 0.5);
      if (!ray || !(ray->direction.z() > 0.0))
        throw DataError("pixel ({}, {}) of the camera does not look at the front face", x, y);
      const Vector3 along = ray->direction / ray->direction.z();
      const auto below = [&](double depth) {  // true if the point of the ray at that depth is still inside the gel
        const Vector3 point = ray->origin + (-depth - ray->origin.z()) * along;
        return depth > surface.indentation(point.x(), point.y());
      };
      // Search from the deepest point upwards, in steps of at most half a pixel sideways, then bisect between the last
      // two positions.
      const double range = deepest - highest, sideways = range * along.head<2>().norm();
      const int steps = std::max(1, static_cast<int>(std::ceil(2.0 * sideways / surface.pixel_m())));
      double inside = deepest, outside = deepest;
      for (int k = 0; k <= steps; ++k) {
        outside = deepest - range * k / steps;
        if (!below(outside)) break;
        inside = outside;
      }
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (inside + outside);
        (below(middle) ? inside : outside) = middle;
      }
      seen.at(x, y, 0) = static_cast<float>(outside);
    }
  }
  return seen;
}

}  // namespace tacipc
