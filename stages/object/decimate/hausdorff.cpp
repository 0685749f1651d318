#include "stages/object/decimate/hausdorff.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "common/mesh/triangle_tree.h"
#include "stages/object/decimate/surface_topology.h"

namespace tacipc {
namespace {

constexpr int kChunk = 256;
constexpr double kSurelyNearer = 1.0 - 1e-12;
constexpr std::int64_t kFewestPerFace = 4;  // the corners and the centroid

struct OneSided {
  double squared = 0.0;
  std::int64_t samples = 0;
};

/// Points on one face: rows parallel to its longest edge. Row 0 is that edge, the last row the opposite corner.
struct Lattice {
  Vector3 from, to, apex;
  int rows;        // number of rows after row 0
  double spacing;  // largest distance between neighbours in a row, and between rows

  Lattice(const TriangleMesh& mesh, int face, double wanted) : spacing(wanted) {
    double longest = -1.0;
    for (int k = 0; k < 3; ++k) {
      const Vector3 a = corner(mesh, face, k), b = corner(mesh, face, (k + 1) % 3);
      if ((b - a).norm() <= longest) continue;
      longest = (b - a).norm();
      from = a, to = b, apex = corner(mesh, face, (k + 2) % 3);
    }
    const double height = longest > 0.0 ? 2.0 * area_vector(mesh, face).norm() / longest : 0.0;
    rows = steps(height);
  }
  int steps(double length) const { return static_cast<int>(std::clamp(std::ceil(length / spacing), 1.0, 1e6)); }
  int row_steps(int row) const { return row == rows ? 0 : steps((to - from).norm() * (rows - row) / rows); }
  Vector3 point(int row, int i) const {
    const double up = static_cast<double>(row) / rows;
    const double along = row == rows ? 0.0 : static_cast<double>(i) / row_steps(row);
    return (1.0 - up) * ((1.0 - along) * from + along * to) + up * apex;
  }
  std::int64_t count() const {
    std::int64_t sum = 1;  // counts the centroid
    for (int row = 0; row <= rows; ++row) sum += row_steps(row) + 1;
    return sum;
  }
};

/// Target spacing, doubled until the lattices hold at most `max_samples` points.
double affordable_spacing(const TriangleMesh& mesh, const HausdorffConfig& config) {
  for (double spacing = config.spacing_m;; spacing *= 2.0) {
    std::int64_t samples = 0;
    const int num_faces = static_cast<int>(mesh.num_triangles());
    for (int f = 0; f < num_faces; ++f) samples += Lattice(mesh, f, spacing).count();
    // Corners and centroids remain regardless of the spacing.
    if (samples <= config.max_samples || samples <= kFewestPerFace * num_faces) return spacing;
  }
}

OneSided farthest_sample(const TriangleMesh& from, const TriangleMesh& to, const HausdorffConfig& config) {
  const TriangleTree tree(to);
  const double spacing = affordable_spacing(from, config);
  const int num_faces = static_cast<int>(from.num_triangles());
  std::atomic<double> farthest = 0.0;  // square of the largest distance so far, shared by all threads
  std::atomic<std::int64_t> samples = 0;
  tbb::parallel_for(tbb::blocked_range<int>(0, num_faces, kChunk), [&](const auto& chunk) {
    int near = 0;
    std::int64_t looked = 0;
    const auto look = [&](const Vector3& point) {
      ++looked;
      double known = farthest.load(std::memory_order_relaxed);
      // Most samples are nearer than a known one, and this test is faster than their distance. The factor is slightly
      // below 1, so that rounding does not make the largest distance depend on the order of the samples.
      if (tree.within(point, kSurelyNearer * known, near)) return;
      const double squared = tree.squared_distance(point);
      while (squared > known && !farthest.compare_exchange_weak(known, squared, std::memory_order_relaxed)) {
      }
    };
    for (int f = chunk.begin(); f < chunk.end(); ++f) {
      const Lattice lattice(from, f, spacing);
      for (int row = 0; row <= lattice.rows; ++row)
        for (int i = 0; i <= lattice.row_steps(row); ++i) look(lattice.point(row, i));
      look((lattice.from + lattice.to + lattice.apex) / 3.0);
    }
    samples.fetch_add(looked, std::memory_order_relaxed);
  });
  return {.squared = farthest, .samples = samples};
}

}  // namespace

Hausdorff hausdorff_distance(const TriangleMesh& first, const TriangleMesh& second, const HausdorffConfig& config) {
  const OneSided forward = farthest_sample(first, second, config);
  const OneSided backward = farthest_sample(second, first, config);
  return {.first_to_second_m = std::sqrt(forward.squared),
          .second_to_first_m = std::sqrt(backward.squared),
          .first_samples = forward.samples,
          .second_samples = backward.samples};
}

}  // namespace tacipc
