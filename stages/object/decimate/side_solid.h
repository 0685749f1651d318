// Makes a solid of one side of a surface that no repair closes.
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Distance between the solid and the visible part of the mesh.
struct SideError {
  double spacing_m = 0.0;  // spacing of the grid in use
  double mean_m = 0.0;
  double max_m = 0.0;
};

/// Solid of the mesh as seen from `side`: the highest points on a grid, joined where neighbours have one, with walls
/// down to a flat back behind the mesh. It is always closed (several sheets may meet in one edge); undercuts are
/// filled. Grids beyond 600 points along the longer side become coarser. The error is the distance from visible points
/// between the grid points to the solid, about one spacing at most next to walls.
/// \throw DataError if the side shows no area
TriangleMesh solid_of_side(const TriangleMesh& mesh, const std::string& side, double spacing_m, SideError& error);

}  // namespace tacipc
