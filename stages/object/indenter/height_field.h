// An object seen from the side that presses: heights on a grid, rounded as a print rounds them.
#pragma once

#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Heights (m) at (x0 + i h, y0 + j h), row j. Nothing there: −infinity.
struct HeightField {
  int columns = 0;
  int rows = 0;
  double x0 = 0.0;
  double y0 = 0.0;
  double spacing = 0.0;
  std::vector<double> z;

  double& at(int i, int j) {
    return z[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i)];
  }
  double at(int i, int j) const { return const_cast<HeightField*>(this)->at(i, j); }
};

/// Highest z of the mesh over every grid point within its bounding box and `margin_m` around it; the grid is centred on
/// the box. Points less than a micrometre outside a triangle's outline count as inside, so that grid lines along walls
/// do not drop out.
HeightField highest_points(const TriangleMesh& mesh, double spacing_m, double margin_m);

/// Morphological opening by a ball (erosion, then dilation of the height field): what a ball of this radius reaches
/// from inside. Convex edges get this radius, flat faces and concave edges stay; details thinner than the ball vanish.
HeightField opened(const HeightField& field, double radius_m);

/// The mesh's highest points, opened by a ball, on a grid of `spacing_m` centred on its box. The opening is done on a
/// grid of at least 24 steps to the radius, which the spacing is a multiple of: a wall counts as standing between two
/// grid points, so on a grid as coarse as the mesh wanted, edges would be off by up to its spacing. They are off by a
/// 24th of the radius at most.
HeightField rounded(const TriangleMesh& mesh, double radius_m, double spacing_m, double margin_m);

/// Closed mesh: the field, cut off `relief_m` below its highest point, walls around, a flat floor as far down again.
/// \pre at least 2 × 2 points
TriangleMesh solid(const HeightField& field, double relief_m);

}  // namespace tacipc
