#include "stages/image/render/height_maps.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "common/base/error.h"
#include "common/sensor/camera_image.h"
#include "common/sensor/camera_model.h"
#include "common/sensor/membrane_view.h"

namespace tacipc {
namespace {

constexpr double kRing = 2.0;  // extent of the ring over that of the field of view, from their common centre

/// Row of the membrane's vertex for a pixel; −1, `width` and `height` are on the ring.
int vertex_of(int x, int y, int width) { return (y + 1) * (width + 2) + x + 1; }

Triangles grid_triangles(int width, int height) {
  Triangles triangles(2 * (width + 1) * (height + 1), 3);
  Eigen::Index row = 0;
  for (int y = -1; y < height; ++y) {
    for (int x = -1; x < width; ++x) {
      const int a = vertex_of(x, y, width), b = vertex_of(x + 1, y, width);
      const int c = vertex_of(x + 1, y + 1, width), d = vertex_of(x, y + 1, width);
      // Diagonals alternate from square to square, so that slopes along both directions are treated alike.
      if ((x + y) % 2 == 0) {
        triangles.row(row++) << a, b, c;
        triangles.row(row++) << a, c, d;
      } else {
        triangles.row(row++) << a, b, d;
        triangles.row(row++) << b, c, d;
      }
    }
  }
  return triangles;
}

}  // namespace

HeightMaps::HeightMaps(std::vector<FloatImage> maps, const Sensor& sensor, bool refract) : maps_(std::move(maps)) {
  if (sensor.gel.dome_radius_m)
    throw DataError("height maps are rendered on flat gels only; the front of {} is a dome", sensor.name);
  const CameraModel rays(sensor.camera, sensor.stack, refract);
  rest_ = flat_view(rays, sensor.camera).rest;
  for (int y = 0; y < sensor.camera.height_px; ++y) {
    for (int x = 0; x < sensor.camera.width_px; ++x) {
      const CameraRay ray = rays.ray(x + 0.5, y + 0.5).value();
      shift_.push_back(ray.direction / ray.direction.z());
    }
  }
}

Membrane HeightMaps::at_rest() const {
  assert(!maps_.empty());
  const int width = maps_.front().width, height = maps_.front().height;
  const Vector3 middle = 0.5 * (rest_.front() + rest_.back());
  Positions rest((width + 2) * (height + 2), 3);
  for (int y = -1; y <= height; ++y) {
    for (int x = -1; x <= width; ++x) {
      const int u = std::clamp(x, 0, width - 1), v = std::clamp(y, 0, height - 1);
      const Vector3& point = rest_[static_cast<std::size_t>(v) * width + u];
      rest.row(vertex_of(x, y, width)) =
          (u == x && v == y ? point : Vector3(middle + kRing * (point - middle))).transpose();
    }
  }
  Triangles triangles = grid_triangles(width, height);
  // Images may be mirrored views of S, but triangles always face out of the gel.
  const Vector3 across = rest_[1] - rest_[0], down = rest_[width] - rest_[0];
  if (across.cross(down).z() < 0.0) triangles.col(1).swap(triangles.col(2));
  return make_membrane(rest, rest, std::move(triangles));
}

void HeightMaps::move(Membrane& membrane, std::size_t frame) const {
  const int width = maps_.front().width, height = maps_.front().height;
  membrane.positions = membrane.rest;
  if (frame > 0) {
    for (int y = -1; y <= height; ++y) {
      for (int x = -1; x <= width; ++x) {
        const int u = std::clamp(x, 0, width - 1), v = std::clamp(y, 0, height - 1);
        const std::size_t pixel = static_cast<std::size_t>(v) * width + u;
        membrane.positions.row(vertex_of(x, y, width)) -=
            double{maps_[frame - 1].at(u, v, 0)} * shift_[pixel].transpose();
      }
    }
  }
  membrane.normals = vertex_normals(membrane.positions, membrane.triangles);
}

std::vector<FloatImage> read_height_maps(const std::vector<std::filesystem::path>& files, const Camera& camera) {
  std::vector<FloatImage> maps;
  for (const auto& file : files) {
    maps.push_back(read_camera_exr(file, {"Y"}, camera));
    for (const float value : maps.back().pixels)
      if (!std::isfinite(value)) throw DataError("{}: has a number that is not finite", file.string());
  }
  return maps;
}

}  // namespace tacipc
