#include "stages/gel/tetmesh/face_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "stages/gel/tetmesh/outline.h"

namespace tacipc {
namespace {

constexpr int kDartRounds = 40;
constexpr int kRelaxSteps = 60;
constexpr double kMoveBeforeNewEdges = 0.1;  // fraction of the target length
constexpr int kDensityTries = 4;
constexpr double kDensityTolerance = 0.015;
/// Distance of darts / target edge length. A saturated random packing of discs covers 0.547 of the plane, so darts at
/// distance d would be as dense as equilateral triangles of edge d √(π / (2 √3 · 0.547)) = 1.288 d. A finite number of
/// darts leaves gaps, and relaxed triangles are not equilateral, which requires 5 % more darts.
constexpr double kDartDistance = 0.735;
constexpr double kRimMargin = 0.55;  // fraction of the target length; equilateral triangles would have 0.87

Vector3 lifted(const Face& face, const Vector2& p) { return {p.x(), p.y(), face.height_m(p)}; }

/// Ratio of a length seen from above to its length down the slope of the face.
double slope_cosine(const Face& face, const Vector2& p) {
  if (!face.dome_radius_m) return 1.0;
  return std::sqrt(std::max(0.0, 1.0 - p.squaredNorm() / (*face.dome_radius_m * *face.dome_radius_m)));
}

/// Triangulates the points on the face. A disc's dome is projected from the foot of its sphere, which maps circles to
/// circles, so that the triangulation is Delaunay on the sphere. A rectangle, whose sides would bend inwards, is seen
/// from above.
Triangles triangulate(const Face& face, const std::vector<Vector2>& points) {
  if (!face.dome_radius_m || face.gel.outline != GelShape::Outline::disc) return delaunay(points);
  std::vector<Vector2> projected;
  projected.reserve(points.size());
  const double diameter = 2.0 * *face.dome_radius_m;
  for (const Vector2& p : points) projected.push_back(p * (diameter / (diameter + face.height_m(p))));
  return delaunay(projected);
}

struct Leaf {
  Vector2 low;
  double size;
};

/// Quadtree leaves over the face, each no larger than the target length in it.
void collect_leaves(const Face& face, const Vector2& low, double size, std::vector<Leaf>& leaves) {
  const Vector2 middle = low.array() + size / 2.0;
  if (distance_inside(face.gel, middle) < -size * 0.7072) return;
  double wanted = face.edge_length_m(middle);
  for (const double dx : {0.0, size})
    for (const double dy : {0.0, size}) wanted = std::min(wanted, face.edge_length_m(low + Vector2(dx, dy)));
  if (size <= wanted) {
    leaves.push_back({low, size});
    return;
  }
  for (const double dx : {0.0, size / 2.0})
    for (const double dy : {0.0, size / 2.0}) collect_leaves(face, low + Vector2(dx, dy), size / 2.0, leaves);
}

/// Points in buckets of a uniform grid, to find near points.
class Buckets {
 public:
  Buckets(const GelShape& gel, double cell_m) {
    const bool disc = gel.outline == GelShape::Outline::disc;
    const Vector2 extent(disc ? 2.0 * gel.radius_m : gel.width_m, disc ? 2.0 * gel.radius_m : gel.height_m);
    constexpr double kMaxCells = 2048.0;  // cells per side
    cell_m_ = std::max(cell_m, extent.maxCoeff() / kMaxCells);
    low_ = -extent / 2.0;
    nx_ = static_cast<int>(extent.x() / cell_m_) + 1;
    ny_ = static_cast<int>(extent.y() / cell_m_) + 1;
    cells_.resize(static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_));
  }

  void add(const Vector2& p, int index) { cells_[cell(column(p.x()), row(p.y()))].push_back(index); }

  /// Whether `test(index)` holds for any point within `reach_m`, or for some beyond.
  template <typename Test>
  bool any_near(const Vector2& p, double reach_m, const Test& test) const {
    for (int y = row(p.y() - reach_m); y <= row(p.y() + reach_m); ++y)
      for (int x = column(p.x() - reach_m); x <= column(p.x() + reach_m); ++x)
        for (const int index : cells_[cell(x, y)])
          if (test(index)) return true;
    return false;
  }

 private:
  int column(double x) const { return std::clamp(static_cast<int>((x - low_.x()) / cell_m_), 0, nx_ - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - low_.y()) / cell_m_), 0, ny_ - 1); }
  std::size_t cell(int x, int y) const { return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + x; }

  Vector2 low_;
  double cell_m_ = 0.0;
  int nx_ = 0, ny_ = 0;
  std::vector<std::vector<int>> cells_;
};

/// The rim and random points inside, no two nearer than `distance` × the target length between them.
std::vector<Vector2> throw_darts(const Face& face, const std::vector<Vector2>& rim, double distance,
                                 std::uint64_t seed) {
  std::vector<Leaf> leaves;
  const double half = face.gel.outline == GelShape::Outline::disc ? face.gel.radius_m
                                                                  : std::max(face.gel.width_m, face.gel.height_m) / 2.0;
  collect_leaves(face, Vector2(-half, -half), 2.0 * half, leaves);
  double smallest = 2.0 * half;
  for (const Leaf& leaf : leaves) smallest = std::min(smallest, leaf.size);
  std::vector<Vector2> points = rim;
  std::vector<double> wanted;
  Buckets buckets(face.gel, smallest);
  for (std::size_t i = 0; i < points.size(); ++i) {
    wanted.push_back(face.edge_length_m(points[i]));
    buckets.add(points[i], static_cast<int>(i));
  }
  std::uint64_t counter = 0;
  for (int round = 0; round < kDartRounds; ++round) {
    for (const Leaf& leaf : leaves) {
      const Vector2 dart =
          leaf.low + leaf.size * Vector2(random_uniform(seed, 0, counter), random_uniform(seed, 1, counter));
      ++counter;
      const double h = face.edge_length_m(dart);
      if (distance_inside(face.gel, dart) < kRimMargin * h * slope_cosine(face, dart)) continue;
      const Vector3 here = lifted(face, dart);
      const bool taken = buckets.any_near(dart, 1.5 * distance * h, [&](int i) {
        return (lifted(face, points[i]) - here).norm() < distance * (h + wanted[i]) / 2.0;
      });
      if (taken) continue;
      buckets.add(dart, static_cast<int>(points.size()));
      points.push_back(dart);
      wanted.push_back(h);
    }
  }
  return points;
}

/// Moves the inner points by repulsive springs. Their rest lengths are slightly longer than the mean edge allows, so
/// that the points press against each other and the rim.
void relax(const Face& face, std::size_t rim_size, std::vector<Vector2>& points) {
  constexpr double kStep = 0.2, kPressure = 1.2;
  std::vector<double> wanted(points.size());
  std::vector<Vector3> lifted_points(points.size());
  std::vector<std::pair<int, int>> edges;
  std::vector<Vector2> points_of_edges;
  for (int step = 0; step < kRelaxSteps; ++step) {
    bool stale = edges.empty();
    for (std::size_t i = 0; i < points.size(); ++i) {
      wanted[i] = face.edge_length_m(points[i]);
      lifted_points[i] = lifted(face, points[i]);
      if (!stale) stale = (points[i] - points_of_edges[i]).norm() > kMoveBeforeNewEdges * wanted[i];
    }
    if (stale) {
      edges = unique_edges(triangulate(face, points));
      points_of_edges = points;
    }
    double squared_ratios = 0.0;
    for (const auto& [i, j] : edges) {
      const double h = (wanted[i] + wanted[j]) / 2.0;
      squared_ratios += (lifted_points[i] - lifted_points[j]).squaredNorm() / (h * h);
    }
    const double scale = kPressure * std::sqrt(squared_ratios / static_cast<double>(edges.size()));
    std::vector<Vector2> push(points.size(), Vector2::Zero());
    for (const auto& [i, j] : edges) {
      const double length = (lifted_points[i] - lifted_points[j]).norm();
      const double missing = scale * (wanted[i] + wanted[j]) / 2.0 - length;
      if (missing <= 0.0) continue;
      const Vector2 force = (points[i] - points[j]) * (missing / length);
      push[i] += force;
      push[j] -= force;
    }
    for (std::size_t i = rim_size; i < points.size(); ++i) {
      points[i] =
          pulled_inside(face.gel, points[i] + kStep * push[i], kRimMargin * wanted[i] * slope_cosine(face, points[i]));
    }
  }
}

double mean_edge_ratio(const Face& face, const FaceMesh& mesh) {
  double sum = 0.0;
  const auto edges = unique_edges(mesh.triangles);
  for (const auto& [i, j] : edges) {
    const Vector2 &p = mesh.points[i], &q = mesh.points[j];
    sum += (lifted(face, p) - lifted(face, q)).norm() * 2.0 / (face.edge_length_m(p) + face.edge_length_m(q));
  }
  return sum / static_cast<double>(edges.size());
}

}  // namespace

std::vector<std::pair<int, int>> unique_edges(const Triangles& triangles) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(static_cast<std::size_t>(3 * triangles.rows()));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    for (int e = 0; e < 3; ++e) {
      const int i = triangles(t, e), j = triangles(t, (e + 1) % 3);
      edges.emplace_back(std::min(i, j), std::max(i, j));
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

FaceMesh mesh_face(const Face& face, const std::vector<Vector2>& rim, std::uint64_t seed) {
  FaceMesh mesh;
  double distance = kDartDistance;
  for (int attempt = 0; attempt < kDensityTries; ++attempt) {
    mesh.points = throw_darts(face, rim, distance, seed);
    relax(face, rim.size(), mesh.points);
    mesh.triangles = triangulate(face, mesh.points);
    const double ratio = mean_edge_ratio(face, mesh);
    if (std::abs(ratio - 1.0) <= kDensityTolerance || mesh.points.size() < 200) break;
    distance /= ratio;
  }
  return mesh;
}

}  // namespace tacipc
