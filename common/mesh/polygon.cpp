#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "common/mesh/mesh_formats.h"

namespace tacipc {
namespace {

using Vector2 = Eigen::Vector2d;

/// Projects a polygon to the coordinate plane in which its area is largest, counter-clockwise.
std::vector<Vector2> flatten(std::span<const int> polygon, const std::vector<Vector3>& vertices) {
  const std::size_t n = polygon.size();
  // Newell: the sum of the cross products of consecutive corners is twice the area vector, planar or not.
  Vector3 area = Vector3::Zero();
  const Vector3& origin = vertices[polygon[0]];
  for (std::size_t i = 1; i + 1 < n; ++i)
    area += (vertices[polygon[i]] - origin).cross(vertices[polygon[i + 1]] - origin);
  Eigen::Index dropped = 0;
  area.cwiseAbs().maxCoeff(&dropped);
  const Eigen::Index i = (dropped + 1) % 3;
  const Eigen::Index j = (dropped + 2) % 3;
  const double mirror = area[dropped] < 0 ? -1.0 : 1.0;
  std::vector<Vector2> flat(n);
  for (std::size_t k = 0; k < n; ++k) flat[k] = {vertices[polygon[k]][i] * mirror, vertices[polygon[k]][j]};
  return flat;
}

double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool inside(const Vector2& p, const Vector2& a, const Vector2& b, const Vector2& c) {
  return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

}  // namespace

void PolygonSoup::add_polygon(std::span<const int> polygon) {
  first_corner.push_back(static_cast<int>(corners.size()));
  corners.insert(corners.end(), polygon.begin(), polygon.end());
}

void PolygonSoup::add_polygon(std::span<const int> polygon, int line) {
  add_polygon(polygon);
  lines.push_back(line);
}

void triangulate_polygon(std::span<const int> polygon, const std::vector<Vector3>& vertices,
                         std::vector<int>& triangle_corners) {
  const std::size_t n = polygon.size();
  const auto emit = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangle_corners.insert(triangle_corners.end(), {polygon[a], polygon[b], polygon[c]});
  };
  std::vector<Vector2> flat;
  bool convex = true;
  if (n > 3) {
    flat = flatten(polygon, vertices);
    for (std::size_t i = 0; convex && i < n; ++i) convex = turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) >= 0;
  }
  if (convex) {
    for (std::size_t i = 1; i + 1 < n; ++i) emit(0, i, i + 1);
    return;
  }
  std::vector<std::size_t> ring(n);
  std::iota(ring.begin(), ring.end(), std::size_t{0});
  while (ring.size() > 3) {
    const std::size_t m = ring.size();
    const auto is_ear = [&](std::size_t k) {
      const std::size_t before = ring[(k + m - 1) % m], tip = ring[k], after = ring[(k + 1) % m];
      if (turn(flat[before], flat[tip], flat[after]) <= 0) return false;
      return std::ranges::none_of(ring, [&](std::size_t other) {
        if (other == before || other == tip || other == after) return false;
        const Vector2& p = flat[other];
        if (p == flat[before] || p == flat[tip] || p == flat[after]) return false;
        return inside(p, flat[before], flat[tip], flat[after]);
      });
    };
    // A polygon that crosses itself or has no area may have no ear; any corner then serves.
    std::size_t ear = 0;
    while (ear < m && !is_ear(ear)) ++ear;
    ear %= m;
    emit(ring[(ear + m - 1) % m], ring[ear], ring[(ear + 1) % m]);
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  emit(ring[0], ring[1], ring[2]);
}

}  // namespace tacipc
