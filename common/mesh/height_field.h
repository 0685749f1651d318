// Heights of a surface, seen along z, on a grid.
#pragma once

#include <limits>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Heights (m) at (x0 + i h, y0 + j h), in rows j.
struct HeightField {
  static constexpr double kNothing = -std::numeric_limits<double>::infinity();

  int columns = 0;
  int rows = 0;
  double x0 = 0.0;
  double y0 = 0.0;
  double spacing = 0.0;
  std::vector<double> z;

  double& at(int i, int j) { return z[static_cast<std::size_t>(j) * columns + i]; }
  double at(int i, int j) const { return const_cast<HeightField*>(this)->at(i, j); }
};

/// Returns the highest z of the mesh at every grid point within its bounding box and `margin_m` around it; the grid is
/// centred on the box. Points less than a micrometre outside a triangle's outline count as inside, so that grid lines
/// along walls do not drop out.
HeightField highest_points(const TriangleMesh& mesh, double spacing_m, double margin_m);

}  // namespace tacipc
