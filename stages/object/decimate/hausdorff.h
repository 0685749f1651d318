// Largest distance between two surfaces.
#pragma once

#include <cstdint>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Sampling of the surfaces.
struct HausdorffConfig {
  double spacing_m = 5e-5;               // spacing of samples on a face
  std::int64_t max_samples = 4'000'000;  // limit per surface; the spacing grows if more samples would be needed
};

/// Distances in both directions, and the numbers of samples.
struct Hausdorff {
  double first_to_second_m = 0.0;  // farthest sample of the first surface from the second
  double second_to_first_m = 0.0;
  std::int64_t first_samples = 0;
  std::int64_t second_samples = 0;

  double max_m() const { return first_to_second_m > second_to_first_m ? first_to_second_m : second_to_first_m; }
};

/// Largest distance from the samples of each surface to the other one. Samples are the vertices, the face centroids and
/// a lattice on each face with at most the spacing between rows and between points of a row. Each distance is exact, so
/// the true value is at most one spacing larger.
Hausdorff hausdorff_distance(const TriangleMesh& first, const TriangleMesh& second, const HausdorffConfig& config);

}  // namespace tacipc
