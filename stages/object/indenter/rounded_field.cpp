#include "stages/object/indenter/rounded_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace tacipc {
namespace {

constexpr double kNoSurface = HeightField::kNothing;

/// Grid point of the disc, and the ball's height above it, m.
struct Offset {
  int u, v;
  double cap;
};

std::vector<Offset> ball_offsets(double radius, double spacing) {
  const int reach = static_cast<int>(std::floor(radius / spacing + 1e-9));
  std::vector<Offset> offsets;
  for (int v = -reach; v <= reach; ++v) {
    for (int u = -reach; u <= reach; ++u) {
      const double squared = radius * radius - (u * u + v * v) * spacing * spacing;
      if (squared >= 0.0) offsets.push_back({u, v, std::sqrt(squared)});
    }
  }
  return offsets;
}

/// Extreme over the disc of `radius` around each point of z + sign · (ball's height there): sign −1 with the smallest
/// value erodes, +1 with the largest value dilates.
HeightField swept(const HeightField& field, double radius, bool dilate) {
  const std::vector<Offset> offsets = ball_offsets(radius, field.spacing);
  HeightField out = field;
  tbb::parallel_for(0, field.rows, [&](int j) {
    for (int i = 0; i < field.columns; ++i) {
      double best = dilate ? kNoSurface : -kNoSurface;
      for (const Offset& o : offsets) {
        const int x = i + o.u, y = j + o.v;
        const bool inside = x >= 0 && y >= 0 && x < field.columns && y < field.rows;
        const double z = inside ? field.at(x, y) : kNoSurface;
        best = dilate ? std::max(best, z + o.cap) : std::min(best, z - o.cap);
        if (!dilate && best == kNoSurface) break;
      }
      out.at(i, j) = best;
    }
  });
  return out;
}

/// Every k-th point, counted from the middle.
HeightField thinned(const HeightField& fine, int k) {
  const int half_columns = fine.columns / 2 / k, half_rows = fine.rows / 2 / k;
  HeightField out{.columns = 2 * half_columns + 1, .rows = 2 * half_rows + 1, .spacing = k * fine.spacing, .z = {}};
  const int i0 = fine.columns / 2 - k * half_columns, j0 = fine.rows / 2 - k * half_rows;
  out.x0 = fine.x0 + i0 * fine.spacing;
  out.y0 = fine.y0 + j0 * fine.spacing;
  for (int j = 0; j < out.rows; ++j)
    for (int i = 0; i < out.columns; ++i) out.z.push_back(fine.at(i0 + k * i, j0 + k * j));
  return out;
}

}  // namespace

HeightField rounded(const TriangleMesh& mesh, double radius_m, double spacing_m, double margin_m) {
  if (radius_m == 0.0) return highest_points(mesh, spacing_m, margin_m);
  constexpr double kStepsPerRadius = 24.0;
  const int k = std::max(1, static_cast<int>(std::ceil(kStepsPerRadius * spacing_m / radius_m)));
  // The box gets a margin of whole coarse steps, so that thinning keeps it.
  const HeightField fine = highest_points(mesh, spacing_m / k, margin_m + spacing_m);
  return thinned(opened(fine, radius_m), k);
}

HeightField opened(const HeightField& field, double radius_m) {
  if (radius_m == 0.0) return field;
  return swept(swept(field, radius_m, false), radius_m, true);
}

TriangleMesh solid(const HeightField& field, double relief_m) {
  assert(field.columns >= 2 && field.rows >= 2);
  const double floor_z = *std::ranges::max_element(field.z) - relief_m;
  const int n = field.columns * field.rows;
  TriangleMesh mesh;
  mesh.positions.resize(2 * n, 3);
  std::vector<std::array<int, 3>> faces;
  const auto id = [&](int i, int j) { return j * field.columns + i; };
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const double x = field.x0 + i * field.spacing, y = field.y0 + j * field.spacing;
      // The outermost points of the walls lie at the cut, so that the walls stand on the floor's outline.
      const bool rim = i == 0 || j == 0 || i + 1 == field.columns || j + 1 == field.rows;
      mesh.positions.row(id(i, j)) << x, y, rim ? floor_z : std::max(field.at(i, j), floor_z);
      mesh.positions.row(n + id(i, j)) << x, y, floor_z - relief_m;
      if (i + 1 == field.columns || j + 1 == field.rows) continue;
      const int a = id(i, j), b = id(i + 1, j), c = id(i + 1, j + 1), d = id(i, j + 1);
      faces.insert(faces.end(), {{a, b, c}, {a, c, d}, {n + a, n + c, n + b}, {n + a, n + d, n + c}});
    }
  }
  const auto wall = [&](int a, int b) { faces.insert(faces.end(), {{a, n + b, b}, {a, n + a, n + b}}); };
  for (int i = 0; i + 1 < field.columns; ++i) {
    wall(id(i, 0), id(i + 1, 0));
    wall(id(i + 1, field.rows - 1), id(i, field.rows - 1));
  }
  for (int j = 0; j + 1 < field.rows; ++j) {
    wall(id(field.columns - 1, j), id(field.columns - 1, j + 1));
    wall(id(0, j + 1), id(0, j));
  }
  mesh.triangles = rows_of<Triangles>(faces);
  return mesh;
}

}  // namespace tacipc
