#include "stages/gel/press/contact/shape_features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "stages/gel/press/contact/sharpness.h"

namespace tacipc {
namespace {

/// Divides a surface into flat faces, creases and corners.
class ShapeFinder {
 public:
  ShapeFinder(const Surface& surface, const Positions& x)
      : surface_(surface), x_(x), triangles_of_edge_(surface.edges.size()) {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) triangles_of_edge_[edge_of(t, k)].push_back(t);
  }

  ShapeFeatures find() {
    find_faces();
    find_creases();
    find_corners();
    join_creases();
    return std::move(out_);
  }

 private:
  struct Plane {
    Vector3 normal;
    double longest_m, height_m;  // longest edge of the triangle, and its height above that edge
  };

  Vector3 at(int v) const { return x_.row(v).transpose(); }
  std::size_t edge_of(std::size_t t, int k) const {
    return index_of_edge(surface_, surface_.triangles[t][k], surface_.triangles[t][(k + 1) % 3]);
  }
  Plane plane_of(std::size_t t) const {
    const auto [a, b, c] = surface_.triangles[t];
    const Vector3 area = (at(b) - at(a)).cross(at(c) - at(a));
    const double longest = std::max({(at(b) - at(a)).norm(), (at(c) - at(b)).norm(), (at(a) - at(c)).norm()});
    return {area.stableNormalized(), longest, longest > 0.0 ? area.norm() / longest : 0.0};
  }
  static bool is_sliver(const Plane& plane) { return !(plane.height_m > kFlat * plane.longest_m); }

  /// Grows faces from the largest triangles: their planes are known most accurately.
  void find_faces() {
    const std::size_t count = surface_.triangles.size();
    std::vector<Plane> planes;
    for (std::size_t t = 0; t < count; ++t) planes.push_back(plane_of(t));
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto size = [&](std::size_t t) { return planes[t].longest_m * planes[t].height_m; };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
    face_.assign(count, count);
    for (const std::size_t seed : order) {
      if (face_[seed] != count) continue;
      face_[seed] = seed;
      if (is_sliver(planes[seed])) continue;
      const Vector3 normal = planes[seed].normal, origin = at(surface_.triangles[seed][0]);
      const auto belongs = [&](std::size_t t) {
        const auto& corners = surface_.triangles[t];
        return (is_sliver(planes[t]) || planes[t].normal.dot(normal) > 0.0) &&
               std::all_of(corners.begin(), corners.end(),
                           [&](int v) { return std::abs(normal.dot(at(v) - origin)) <= kFlat * planes[t].longest_m; });
      };
      for (std::vector<std::size_t> open{seed}; !open.empty();) {
        const std::size_t t = open.back();
        open.pop_back();
        for (int k = 0; k < 3; ++k) {
          const auto& sides = triangles_of_edge_[edge_of(t, k)];
          if (sides.size() != 2) continue;
          const std::size_t other = sides[0] == t ? sides[1] : sides[0];
          if (face_[other] != count || !belongs(other)) continue;
          face_[other] = seed;
          open.push_back(other);
        }
      }
    }
  }

  void find_creases() {
    out_.is_corner.assign(static_cast<std::size_t>(x_.rows()), 0);
    out_.crease.resize(surface_.edges.size());
    out_.is_flat.assign(surface_.edges.size(), 0);
    out_.on_rim.assign(static_cast<std::size_t>(x_.rows()), 0);
    creases_at_.resize(static_cast<std::size_t>(x_.rows()));
    for (std::size_t e = 0; e < surface_.edges.size(); ++e) {
      const auto& sides = triangles_of_edge_[e];
      if (sides.size() == 2 && face_[sides[0]] == face_[sides[1]]) out_.is_flat[e] = 1;
      if (out_.is_flat[e]) continue;
      for (const int v : surface_.edges[e]) {
        out_.on_rim[static_cast<std::size_t>(v)] = 1;
        creases_at_[static_cast<std::size_t>(v)].push_back(e);
      }
    }
  }

  int other_end(std::size_t e, int v) const {
    const auto [a, b] = surface_.edges[e];
    return v == a ? b : a;
  }
  /// Direction from v along the edge e.
  Vector3 direction(std::size_t e, int v) const { return (at(other_end(e, v)) - at(v)).stableNormalized(); }

  void find_corners() {
    for (const int v : surface_.vertices) {
      const auto& creases = creases_at_[static_cast<std::size_t>(v)];
      if (creases.empty()) continue;
      const bool straight = creases.size() == 2 && goes_on(-direction(creases[0], v), direction(creases[1], v));
      if (!straight) add_corner(v);
    }
  }

  static bool goes_on(const Vector3& before, const Vector3& after) {
    return before.dot(after) > 0.0 && before.cross(after).norm() <= kFlat;
  }

  void add_corner(int v) {
    out_.is_corner[static_cast<std::size_t>(v)] = 1;
    corners_.push_back(v);
  }

  /// Joins consecutive edges between two corners. A corner is added where a row of edges bends gradually.
  void join_creases() {
    std::size_t next_edge = 0;
    for (std::size_t c = 0; true; ++c) {
      if (c == corners_.size()) {
        // A ring that bends less than kFlat from edge to edge has no corner to start from.
        while (next_edge < surface_.edges.size() && !is_open(next_edge)) ++next_edge;
        if (next_edge == surface_.edges.size()) return;
        add_corner(surface_.edges[next_edge][0]);
      }
      const int corner = corners_[c];
      for (const std::size_t e : creases_at_[static_cast<std::size_t>(corner)])
        if (is_open(e)) follow(corner, e);
    }
  }

  bool is_open(std::size_t e) const { return out_.is_flat[e] == 0 && out_.crease[e][0] == out_.crease[e][1]; }

  void follow(int corner, std::size_t edge) {
    const Vector3 along = direction(edge, corner);
    std::vector<std::size_t> row{edge};
    int v = other_end(edge, corner);
    while (!out_.is_corner[static_cast<std::size_t>(v)]) {
      const auto& creases = creases_at_[static_cast<std::size_t>(v)];
      const std::size_t next = creases[0] == row.back() ? creases[1] : creases[0];
      if (!goes_on(along, direction(next, v))) {
        add_corner(v);
        break;
      }
      row.push_back(next);
      v = other_end(next, v);
    }
    for (const std::size_t e : row) out_.crease[e] = {std::min(corner, v), std::max(corner, v)};
  }

  const Surface& surface_;
  const Positions& x_;
  std::vector<std::vector<std::size_t>> triangles_of_edge_;
  std::vector<std::size_t> face_;                     // face of each triangle, by the triangle from which it was grown
  std::vector<std::vector<std::size_t>> creases_at_;  // creases at each vertex, by edges
  std::vector<int> corners_;
  ShapeFeatures out_;
};

}  // namespace

ShapeFeatures shape_features(const Surface& surface, const Positions& positions) {
  return ShapeFinder(surface, positions).find();
}

}  // namespace tacipc
