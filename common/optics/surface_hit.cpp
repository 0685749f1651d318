#include "common/optics/surface_hit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace tacipc {
namespace {

/// Returns barycentric weights of the point where a line meets a triangle's plane, clamped to the triangle. The ray
/// tracer found the hit in single precision, so a point outside is due to rounding, or the line lies in the plane.
Vector3 barycentric(const std::array<Vector3, 3>& v, const Ray& ray) {
  const Vector3 e1 = v[1] - v[0], e2 = v[2] - v[0];
  const Vector3 p = ray.direction.cross(e2);
  const double determinant = e1.dot(p);
  const Vector3 t = ray.origin - v[0];
  const double b1 = t.dot(p) / determinant, b2 = ray.direction.dot(t.cross(e1)) / determinant;
  Vector3 weights(1.0 - b1 - b2, b1, b2);
  if (!weights.allFinite()) return Vector3::Constant(1.0 / 3.0);
  weights = weights.cwiseMax(0.0);
  return weights / weights.sum();
}

}  // namespace

SurfaceHit surface_hit(const Membrane& membrane, int triangle, const Ray& ray) {
  constexpr double kOffset = 1e-7;
  std::array<Vector3, 3> v, n;
  std::array<double, 3> lowering{};
  for (int k = 0; k < 3; ++k) {
    const int row = membrane.triangles(triangle, k);
    v[k] = membrane.positions.row(row).transpose();
    n[k] = -membrane.normals.row(row).transpose();
    lowering[k] = membrane.rest(row, 2) - membrane.positions(row, 2);
  }
  const Vector3 b = barycentric(v, ray);
  const Vector3 face_normal = -(v[1] - v[0]).cross(v[2] - v[0]).normalized();
  SurfaceHit hit;
  hit.triangle = triangle;
  hit.weights = b;
  hit.point = b[0] * v[0] + b[1] * v[1] + b[2] * v[2];
  hit.inner_normal = (b[0] * n[0] + b[1] * n[1] + b[2] * n[2]).normalized();
  hit.indentation = b[0] * lowering[0] + b[1] * lowering[1] + b[2] * lowering[2];
  hit.from_inside = face_normal.dot(ray.direction) < 0.0;
  hit.shadow_origin = hit.point + kOffset * face_normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const double below = std::min(0.0, n[k].dot(hit.point - v[k]));
    hit.shadow_origin -= b[k] * below * n[k];
  }
  return hit;
}

bool inside_outline(const Membrane& membrane, const Ray& ray) {
  constexpr double kTolerance = 1e-8;
  const Vector3 u = ray.direction.unitOrthogonal(), w = ray.direction.cross(u);
  const auto project = [&](int row) {
    const Vector3 from_ray = membrane.positions.row(row).transpose() - ray.origin;
    return Eigen::Vector2d(u.dot(from_ray), w.dot(from_ray));
  };
  int winding = 0;
  for (const auto& edge : membrane.outline) {
    const Eigen::Vector2d a = project(edge[0]), b = project(edge[1]), ab = b - a;
    const double t = std::clamp(-a.dot(ab) / std::max(ab.squaredNorm(), 1e-300), 0.0, 1.0);
    if ((a + t * ab).norm() < kTolerance) return false;
    const double side = a.x() * b.y() - a.y() * b.x();  // > 0: the line is to the left of the edge
    if (a.y() <= 0.0 && b.y() > 0.0 && side > 0.0) ++winding;
    if (a.y() > 0.0 && b.y() <= 0.0 && side < 0.0) --winding;
  }
  return winding != 0;
}

}  // namespace tacipc
