#include "stages/rival/mpm/object_points.h"

#include <cmath>

#include "common/base/error.h"
#include "common/base/rng.h"

namespace tacipc {
namespace {

struct Corners {
  Vector3 a, b, c;
  Corners(const TriangleMesh& mesh, Eigen::Index t)
      : a(mesh.positions.row(mesh.triangles(t, 0))),
        b(mesh.positions.row(mesh.triangles(t, 1))),
        c(mesh.positions.row(mesh.triangles(t, 2))) {}
  double area() const { return 0.5 * (b - a).cross(c - a).norm(); }
};

}  // namespace

double surface_area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < mesh.num_triangles(); ++t) sum += Corners(mesh, t).area();
  return sum;
}

Positions sample_surface(const TriangleMesh& mesh, int count, std::uint64_t seed) {
  constexpr std::uint64_t kStream = 0x706f696e7473;  // "points"
  const double area = surface_area(mesh);
  if (!(area > 0.0)) throw DataError("the object's surface has no area");
  Positions points(count, 3);
  Eigen::Index triangle = 0;
  double before = 0.0, here = Corners(mesh, 0).area();
  for (int i = 0; i < count; ++i) {
    const auto counter = 3 * static_cast<std::uint64_t>(i);
    const double at = (i + random_uniform(seed, kStream, counter)) * area / count;
    while (before + here < at && triangle + 1 < mesh.num_triangles()) {
      before += here;
      here = Corners(mesh, ++triangle).area();
    }
    // Uniform over a triangle: the square root compensates the decreasing width of strips towards the first corner.
    const double u = std::sqrt(random_uniform(seed, kStream, counter + 1)),
                 v = random_uniform(seed, kStream, counter + 2);
    const Corners corners(mesh, triangle);
    points.row(i) = ((1.0 - u) * corners.a + u * (1.0 - v) * corners.b + u * v * corners.c).transpose();
  }
  return points;
}

}  // namespace tacipc
