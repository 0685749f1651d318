#include "stages/object/emboss/coin.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tacipc {
namespace {

using std::numbers::pi;

constexpr double kGrowth = 1.5;

int count_at(double radius, double spacing) { return 6 * std::max(1, static_cast<int>(std::lround(radius / spacing))); }

/// Positions of rings on an interval of this length after a ring with `spacing`. Steps grow up to `widest` and are then
/// scaled so that they end at the length. `spacing` becomes the last step.
std::vector<double> growing_steps(double length, double widest, double& spacing) {
  std::vector<double> at;
  double sum = 0.0;
  do {
    spacing = std::min(kGrowth * spacing, widest);
    sum += spacing;
    at.push_back(sum);
  } while (sum + 0.5 * spacing < length);
  for (double& s : at) s *= length / sum;
  spacing *= length / sum;
  return at;
}

/// Triangles between a ring of m vertices from index a and the next one of n vertices from index b.
void zip(std::vector<Eigen::Vector3i>& triangles, int a, int m, int b, int n) {
  for (int i = 0, j = 0; i < m || j < n;) {
    // Step on the ring whose next edge has its middle at the smaller angle: (i + ½)/m against (j + ½)/n.
    const bool step_outer = i == m || (j < n && std::int64_t{2 * j + 1} * m <= std::int64_t{2 * i + 1} * n);
    const int p = a + i % m, q = b + j % n;
    if (step_outer) {
      triangles.emplace_back(p, q, b + (++j) % n);
    } else {
      triangles.emplace_back(p, q, a + (++i) % m);
    }
  }
}

}  // namespace

std::vector<Ring> coin_rings(const CoinShape& shape, double spacing_m) {
  std::vector<Ring> rings;
  const double flat = shape.face_radius_m(), fillet = shape.fillet_m;
  const int face_rings = std::max(1, static_cast<int>(std::ceil(flat / spacing_m)));
  const double h = flat / face_rings;
  for (int k = 1; k <= face_rings; ++k) rings.push_back({k * h, shape.thickness_m, 6 * k});

  const int arc_rings = fillet > 0.0 ? std::max(1, static_cast<int>(std::ceil(fillet * pi / 2 / h))) : 0;
  for (int k = 1; k <= arc_rings; ++k) {
    const double angle = pi / 2 * k / arc_rings;
    const double radius = k == arc_rings ? shape.radius_m : flat + fillet * std::sin(angle);
    rings.push_back({radius, shape.thickness_m - fillet * (1.0 - std::cos(angle)), count_at(radius, h)});
  }

  const double widest = std::max(h, shape.radius_m / 12.0), wall = shape.thickness_m - fillet;
  double step = h;
  for (const double s : growing_steps(wall, widest, step))
    rings.push_back({shape.radius_m, s == wall ? 0.0 : wall - s, count_at(shape.radius_m, step)});
  rings.back().z_m = 0.0;
  for (const double s : growing_steps(shape.radius_m, widest, step))
    if (const double radius = shape.radius_m - s; radius > 0.5 * step)
      rings.push_back({radius, 0.0, count_at(radius, step)});
  return rings;
}

int coin_vertices(const std::vector<Ring>& rings) {
  int sum = 2;
  for (const Ring& ring : rings) sum += ring.count;
  return sum;
}

double coin_spacing(const CoinShape& shape, int vertices) {
  double spacing = shape.radius_m;
  while (coin_vertices(coin_rings(shape, spacing)) < vertices) spacing *= 0.995;
  return spacing;
}

TriangleMesh coin_mesh(const CoinShape& shape, double spacing_m, const Height& relief_m) {
  const std::vector<Ring> rings = coin_rings(shape, spacing_m);
  std::vector<int> first;  // first vertex of each ring
  int next = 1;
  for (const Ring& ring : rings) {
    first.push_back(next);
    next += ring.count;
  }
  TriangleMesh mesh;
  mesh.positions.resize(next + 1, 3);
  mesh.positions.row(0) = Vector3(0.0, 0.0, shape.thickness_m + relief_m(Vector2::Zero()));
  mesh.positions.row(next) = Vector3::Zero();
  tbb::parallel_for(std::size_t{0}, rings.size(), [&](std::size_t k) {
    const Ring& ring = rings[k];
    const bool on_face = ring.radius_m < shape.face_radius_m() && ring.z_m == shape.thickness_m;
    for (int i = 0; i < ring.count; ++i) {
      const double angle = 2 * pi * i / ring.count;
      const Vector2 p = ring.radius_m * Vector2(std::cos(angle), std::sin(angle));
      mesh.positions.row(first[k] + i) = Vector3(p.x(), p.y(), ring.z_m + (on_face ? relief_m(p) : 0.0));
    }
  });

  std::vector<Eigen::Vector3i> triangles;
  triangles.reserve(2 * static_cast<std::size_t>(next));
  const int inner = rings.front().count, last = rings.back().count;
  for (int i = 0; i < inner; ++i) triangles.emplace_back(0, first.front() + i, first.front() + (i + 1) % inner);
  for (std::size_t k = 0; k + 1 < rings.size(); ++k)
    zip(triangles, first[k], rings[k].count, first[k + 1], rings[k + 1].count);
  for (int i = 0; i < last; ++i) triangles.emplace_back(first.back() + i, next, first.back() + (i + 1) % last);
  mesh.triangles = rows_of<Triangles>(triangles);
  return mesh;
}

}  // namespace tacipc
