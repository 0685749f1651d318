#include "stages/rival/baseline/object_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/base/error.h"

namespace tacipc {
namespace {

struct RayHit {
  double depth = 0.0;                   // depth along the camera's axis
  std::array<double, 3> barycentric{};  // barycentric coordinates, sum 1
};

/// Intersection of the ray from the origin with triangle (a, b, c). The signed volumes of the ray with the three edges
/// have one sign inside. An edge's volume has the same magnitude and opposite sign in its two triangles, so no ray
/// passes between them, and a ray through an edge hits both.
std::optional<RayHit> ray_hit(const Vector3& ray, const Vector3& a, const Vector3& b, const Vector3& c) {
  const double u = ray.dot(b.cross(c)), v = ray.dot(c.cross(a)), w = ray.dot(a.cross(b));
  const bool inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
  const double sum = u + v + w;
  if (!inside || sum == 0.0) return std::nullopt;
  return RayHit{(u * a.z() + v * b.z() + w * c.z()) / sum, {u / sum, v / sum, w / sum}};
}

}  // namespace

ObjectCamera::ObjectCamera(const Sensor& sensor, ObjectRays rays)
    : camera_(sensor.camera),
      gel_(sensor.gel),
      model_(sensor.camera, sensor.stack, rays == ObjectRays::refracted),
      rays_(rays),
      nearest_z_m_(rays == ObjectRays::refracted && sensor.stack.refracts() ? -sensor.stack.gel_thickness_m
                                                                            : sensor.camera.position_m.z()) {
  for (int y = 0; y < camera_.height_px; ++y) {
    for (int x = 0; x < camera_.width_px; ++x) {
      const auto ray = model_.ray(x + 0.5, y + 0.5);
      const auto foot = model_.on_plane(x + 0.5, y + 0.5);
      if (!ray || !foot) throw DataError("pixel ({}, {}) of the camera does not look at the front face", x, y);
      lines_.push_back(rays == ObjectRays::parallel
                           ? Line{{foot->x(), foot->y(), camera_.position_m.z()}, Vector3::UnitZ()}
                           : Line{ray->origin, ray->direction});
    }
  }
}

SeenObject ObjectCamera::see(const TriangleMesh& object, const Positions& vertex_normals,
                             const Matrix4& gel_from_object, const std::string& name) const {
  const Matrix3 turn = gel_from_object.topLeftCorner<3, 3>();
  const Vector3 shift = gel_from_object.topRightCorner<3, 1>();
  std::vector<Vector3> placed;
  double pressed = 0.0;
  std::vector<Eigen::Vector2d> pixel;  // NaN: no image point shows the vertex
  for (Eigen::Index i = 0; i < object.num_vertices(); ++i) {
    const Vector3 p = turn * object.positions.row(i).transpose() + shift;
    if (!(p.z() > nearest_z_m_)) throw DataError("{}: the object reaches the camera", name);
    const auto shown = model_.project(rays_ == ObjectRays::parallel ? Vector3(p.x(), p.y(), 0.0) : p);
    placed.push_back(p);
    pressed = std::max(pressed, -p.z());
    pixel.push_back(shown.value_or(Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN())));
  }
  SeenObject seen{.depth = Raster(camera_.width_px, camera_.height_px, std::numeric_limits<double>::infinity()),
                  .pressed_m = pressed};
  if (vertex_normals.rows() > 0) seen.normal.assign(seen.depth.values.size(), Vector3::Zero());
  // The box is one pixel larger on each side than the exact one, because rounding and slightly bent edges must not cut
  // off a part of a triangle.
  const auto first = [](double low) { return static_cast<int>(std::floor(std::max(low - 1.5, 0.0))); };
  const auto last = [](double high, int count) {
    return static_cast<int>(std::ceil(std::min(high + 0.5, count - 1.0)));
  };
  for (Eigen::Index t = 0; t < object.num_triangles(); ++t) {
    const std::array<std::size_t, 3> corner{static_cast<std::size_t>(object.triangles(t, 0)),
                                            static_cast<std::size_t>(object.triangles(t, 1)),
                                            static_cast<std::size_t>(object.triangles(t, 2))};
    const auto [left, right] = std::minmax({pixel[corner[0]].x(), pixel[corner[1]].x(), pixel[corner[2]].x()});
    const auto [top, bottom] = std::minmax({pixel[corner[0]].y(), pixel[corner[1]].y(), pixel[corner[2]].y()});
    if (std::isnan(left + right + top + bottom)) continue;
    for (int y = first(top); y <= last(bottom, camera_.height_px); ++y) {
      for (int x = first(left); x <= last(right, camera_.width_px); ++x) {
        const Line& ray = line(x, y);
        const auto hit = ray_hit(ray.direction, placed[corner[0]] - ray.origin, placed[corner[1]] - ray.origin,
                                 placed[corner[2]] - ray.origin);
        if (!hit) continue;
        const double depth = hit->depth + ray.origin.z() - camera_.position_m.z();
        if (!(depth < seen.depth.at(x, y))) continue;
        seen.depth.at(x, y) = depth;
        if (seen.normal.empty()) continue;
        Vector3 normal = Vector3::Zero();
        for (std::size_t k = 0; k < 3; ++k)
          normal += hit->barycentric[k] * vertex_normals.row(object.triangles(t, static_cast<Eigen::Index>(k)));
        seen.normal[static_cast<std::size_t>(y) * camera_.width_px + x] = turn * normal.normalized();
      }
    }
  }
  for (double& value : seen.depth.values)
    if (std::isinf(value)) value = std::numeric_limits<double>::quiet_NaN();
  return seen;
}

Raster ObjectCamera::front() const {
  Raster depth(camera_.width_px, camera_.height_px, -camera_.position_m.z());
  if (!gel_.dome_radius_m) return depth;
  // Sphere around (0, 0, −R) through the origin: the farther intersection with the ray is on the object's side.
  const double radius = *gel_.dome_radius_m;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const Line& ray = line(x, y);
      const Vector3 center = Vector3(0.0, 0.0, -radius) - ray.origin;
      const double a = ray.direction.squaredNorm(), b = ray.direction.dot(center),
                   c = center.squaredNorm() - radius * radius;
      const double discriminant = b * b - a * c;
      depth.at(x, y) = discriminant < 0.0 ? std::numeric_limits<double>::quiet_NaN()
                                          : ray.origin.z() - camera_.position_m.z() +
                                                (b + std::sqrt(discriminant)) / a * ray.direction.z();
    }
  }
  return depth;
}

}  // namespace tacipc
