#include "stages/gel/press/contact/intersection_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/statistics.h"
#include "common/mesh/exact_predicates.h"

namespace tacipc {
namespace {

struct Bounds {
  Eigen::Array3d low, high;
};

template <typename Cells>
void check_cells(const char* what, const Positions& positions, const Cells& cells) {
  for (Eigen::Index i = 0; i < cells.rows(); ++i)
    for (Eigen::Index j = 0; j < cells.cols(); ++j) {
      const int vertex = cells(i, j);
      if (vertex < 0 || vertex >= positions.rows())
        throw DataError("{} {} refers to vertex {}, but there are {} vertices", what, i, vertex, positions.rows());
      if (!positions.row(vertex).allFinite())
        throw DataError("{} {}: vertex {} has a coordinate that is not finite", what, i, vertex);
    }
}

TrianglePoints corners(const SurfaceView& surface, int triangle) {
  TrianglePoints points;
  for (int i = 0; i < 3; ++i) points[i] = surface.positions.row(surface.triangles(triangle, i)).transpose();
  return points;
}

std::array<int, 3> vertices(const SurfaceView& surface, int triangle) {
  return {surface.triangles(triangle, 0), surface.triangles(triangle, 1), surface.triangles(triangle, 2)};
}

std::vector<Bounds> bounds_of(const SurfaceView& surface) {
  std::vector<Bounds> bounds(surface.triangles.rows());
  for (std::size_t t = 0; t < bounds.size(); ++t) {
    const TrianglePoints p = corners(surface, static_cast<int>(t));
    bounds[t] = {p[0].cwiseMin(p[1]).cwiseMin(p[2]).array(), p[0].cwiseMax(p[1]).cwiseMax(p[2]).array()};
  }
  return bounds;
}

/// Strips of equal width along an axis, and the boxes that reach into each.
struct Strips {
  int axis;
  double first, width;
  std::vector<std::vector<int>> boxes;

  int of(double coordinate) const {
    if (boxes.size() == 1) return 0;
    const double strip = std::floor((coordinate - first) / width);
    return static_cast<int>(std::clamp(strip, 0.0, static_cast<double>(boxes.size() - 1)));
  }
};

/// Strips along one axis, each about four times as wide as the median box.
Strips make_strips(const std::vector<Bounds>& bounds, const Bounds& all, int axis) {
  std::vector<double> widths;
  for (const Bounds& b : bounds) widths.push_back(b.high[axis] - b.low[axis]);
  const double typical = upper_median(std::move(widths));
  const double length = all.high[axis] - all.low[axis];
  const auto most = static_cast<double>(bounds.size());
  const double count = typical > 0.0 ? std::floor(std::clamp(length / (4.0 * typical), 1.0, most)) : 1.0;
  Strips strips{axis, all.low[axis], length / count, {}};
  strips.boxes.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < static_cast<int>(bounds.size()); ++i) {
    for (int s = strips.of(bounds[i].low[axis]); s <= strips.of(bounds[i].high[axis]); ++s)
      strips.boxes[s].push_back(i);
  }
  return strips;
}

/// Bounds of all boxes. \pre there is one
Bounds around(const std::vector<Bounds>& bounds) {
  Bounds all = bounds.front();
  for (const Bounds& b : bounds) all = {all.low.min(b.low), all.high.max(b.high)};
  return all;
}

bool overlap(const Bounds& a, const Bounds& b) { return (a.low <= b.high).all() && (b.low <= a.high).all(); }

/// Sort and sweep, strip by strip. Calls visit(i, j) once for all overlapping boxes i < j with `wanted(i, j)`.
template <typename Wanted, typename Visit>
void sweep(const std::vector<Bounds>& bounds, const Wanted& wanted, const Visit& visit) {
  if (bounds.empty()) return;
  const Bounds all = around(bounds);
  // Sweep along the two longest axes.
  Eigen::Array3d lengths = all.high - all.low;
  int axis = 0, across = 0;
  lengths.maxCoeff(&axis);
  lengths[axis] = -1.0;
  lengths.maxCoeff(&across);
  Strips strips = make_strips(bounds, all, across);
  struct Active {
    Bounds box;
    int index;
  };
  std::vector<Active> active;  // copied side by side: most of them are only tested for overlap
  for (std::size_t strip = 0; strip < strips.boxes.size(); ++strip) {
    std::vector<int>& order = strips.boxes[strip];
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return bounds[a].low[axis] != bounds[b].low[axis] ? bounds[a].low[axis] < bounds[b].low[axis] : a < b;
    });
    active.clear();
    for (const int current : order) {
      const Bounds box = bounds[current];
      std::size_t kept = 0;
      for (std::size_t a = 0; a < active.size(); ++a) {
        if (active[a].box.high[axis] < box.low[axis]) continue;
        if (kept != a) active[kept] = active[a];
        const Active& other = active[kept++];
        if (!overlap(box, other.box)) continue;
        const auto [i, j] = std::minmax(current, other.index);
        if (!wanted(i, j)) continue;
        // Two boxes that share several strips are paired in the first of these.
        const double common = std::max(box.low[strips.axis], other.box.low[strips.axis]);
        if (strips.of(common) == static_cast<int>(strip)) visit(i, j);
      }
      active.resize(kept);
      active.push_back({box, current});
    }
  }
}

}  // namespace

std::int64_t count_intersections(const SurfaceView& gel, const SurfaceView& object) {
  check_cells("gel triangle", gel.positions, gel.triangles);
  check_cells("object triangle", object.positions, object.triangles);
  std::vector<Bounds> bounds = bounds_of(gel);
  const int num_gel = static_cast<int>(bounds.size());
  if (bounds.empty()) return 0;
  const Bounds whole_gel = around(bounds);
  const std::vector<Bounds> object_bounds = bounds_of(object);
  std::vector<int> object_triangle;  // triangles that are near the gel
  for (std::size_t t = 0; t < object_bounds.size(); ++t) {
    if (!overlap(object_bounds[t], whole_gel)) continue;
    bounds.push_back(object_bounds[t]);
    object_triangle.push_back(static_cast<int>(t));
  }
  std::int64_t count = 0;
  // Gel triangles come first in the joint numbering.
  sweep(
      bounds, [&](int i, int j) { return i < num_gel && j >= num_gel; },
      [&](int i, int j) {
        const int t = object_triangle[static_cast<std::size_t>(j - num_gel)];
        if (triangles_intersect(corners(gel, i), corners(object, t))) ++count;
      });
  return count;
}

std::int64_t count_self_intersections(const SurfaceView& gel) {
  check_cells("gel triangle", gel.positions, gel.triangles);
  std::int64_t count = 0;
  sweep(
      bounds_of(gel), [](int, int) { return true; },
      [&](int i, int j) {
        if (mesh_triangles_intersect(vertices(gel, i), corners(gel, i), vertices(gel, j), corners(gel, j))) ++count;
      });
  return count;
}

double winding_number(const Vector3& point, const SurfaceView& surface) {
  double angle = 0.0;
  for (Eigen::Index t = 0; t < surface.triangles.rows(); ++t) {
    std::array<Vector3, 3> r;
    std::array<double, 3> d{};
    for (int k = 0; k < 3; ++k) {
      r[k] = surface.positions.row(surface.triangles(t, k)).transpose() - point;
      d[k] = r[k].norm();
    }
    const double volume = r[0].dot(r[1].cross(r[2]));
    const double scale = d[0] * d[1] * d[2] + r[0].dot(r[1]) * d[2] + r[1].dot(r[2]) * d[0] + r[2].dot(r[0]) * d[1];
    angle += 2.0 * std::atan2(volume, scale);
  }
  return angle / (4.0 * std::numbers::pi);
}

std::int64_t count_inverted_tets(const Positions& positions, const Tetrahedra& tets) {
  check_cells("tetrahedron", positions, tets);
  std::int64_t inverted = 0;
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    std::array<Vector3, 4> x;
    for (int i = 0; i < 4; ++i) x[i] = positions.row(tets(t, i)).transpose();
    if (orient3d(x[0], x[1], x[2], x[3]) <= 0) ++inverted;
  }
  return inverted;
}

}  // namespace tacipc
