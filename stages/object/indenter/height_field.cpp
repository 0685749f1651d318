#include "stages/object/indenter/height_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace tacipc {
namespace {

constexpr double kNoSurface = -std::numeric_limits<double>::infinity();

/// A grid point of the disc and the ball's height over it, m.
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

/// Extreme over the disc of `radius` about each point of z + sign · (ball's height there); sign −1 with the smallest
/// erodes, +1 with the largest dilates.
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

HeightField highest_points(const TriangleMesh& mesh, double spacing_m, double margin_m) {
  const Eigen::RowVector3d low = mesh.positions.colwise().minCoeff(), high = mesh.positions.colwise().maxCoeff();
  const auto count = [&](int axis) {
    return 2 * static_cast<int>(std::ceil((0.5 * (high[axis] - low[axis]) + margin_m) / spacing_m)) + 1;
  };
  HeightField field{.columns = count(0), .rows = count(1), .spacing = spacing_m, .z = {}};
  field.x0 = 0.5 * (low[0] + high[0]) - 0.5 * (field.columns - 1) * spacing_m;
  field.y0 = 0.5 * (low[1] + high[1]) - 0.5 * (field.rows - 1) * spacing_m;
  field.z.assign(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows), kNoSurface);
  constexpr double kEdgeSlack = 1e-6;
  for (Eigen::Index t = 0; t < mesh.num_triangles(); ++t) {
    std::array<Vector3, 3> p;
    for (int k = 0; k < 3; ++k) p[static_cast<std::size_t>(k)] = mesh.positions.row(mesh.triangles(t, k));
    const double area = (p[1] - p[0]).cross(p[2] - p[0]).z();
    const double longest =
        std::max({(p[1] - p[0]).head<2>().norm(), (p[2] - p[1]).head<2>().norm(), (p[0] - p[2]).head<2>().norm()});
    if (std::abs(area) <= 1e-9 * longest * longest) continue;  // upright: its edges belong to others
    const auto [left, right] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto [bottom, top] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    const auto first = [&](double at, double start) {
      return std::max(0, static_cast<int>(std::floor((at - start) / spacing_m)));
    };
    const auto last = [&](double at, double start, int n) {
      return std::min(n - 1, static_cast<int>(std::ceil((at - start) / spacing_m)));
    };
    for (int j = first(bottom, field.y0); j <= last(top, field.y0, field.rows); ++j) {
      for (int i = first(left, field.x0); i <= last(right, field.x0, field.columns); ++i) {
        const Vector3 q(field.x0 + i * spacing_m, field.y0 + j * spacing_m, 0.0);
        double z = 0.0;
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const Vector3 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
          const double part = ((b - a).x() * (q - a).y() - (b - a).y() * (q - a).x()) / area;
          // The distance from the edge, times its length, is what `part` measures.
          inside = inside && part >= -kEdgeSlack * (b - a).head<2>().norm() / std::abs(area);
          z += part * p[k].z();
        }
        if (inside) field.at(i, j) = std::max(field.at(i, j), std::min(z, std::max({p[0].z(), p[1].z(), p[2].z()})));
      }
    }
  }
  return field;
}

HeightField rounded(const TriangleMesh& mesh, double radius_m, double spacing_m, double margin_m) {
  if (radius_m == 0.0) return highest_points(mesh, spacing_m, margin_m);
  constexpr double kStepsPerRadius = 24.0;
  const int k = std::max(1, static_cast<int>(std::ceil(kStepsPerRadius * spacing_m / radius_m)));
  // Whole coarse steps around the box, so that thinning keeps the margin.
  const HeightField fine = highest_points(mesh, spacing_m / k, margin_m + spacing_m);
  return thinned(opened(fine, radius_m), k);
}

HeightField opened(const HeightField& field, double radius_m) {
  if (radius_m == 0.0) return field;
  return swept(swept(field, radius_m, false), radius_m, true);
}

TriangleMesh solid(const HeightField& field, double relief_m) {
  assert(field.columns >= 2 && field.rows >= 2);
  const double floor_z = *std::max_element(field.z.begin(), field.z.end()) - relief_m;
  const int n = field.columns * field.rows;
  TriangleMesh mesh;
  mesh.positions.resize(2 * n, 3);
  std::vector<std::array<int, 3>> faces;
  const auto id = [&](int i, int j) { return j * field.columns + i; };
  for (int j = 0; j < field.rows; ++j) {
    for (int i = 0; i < field.columns; ++i) {
      const double x = field.x0 + i * field.spacing, y = field.y0 + j * field.spacing;
      // Around the outside the walls start at the cut, so that they stand on the floor's outline.
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
  mesh.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      mesh.triangles(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) = faces[f][k];
  return mesh;
}

}  // namespace tacipc
