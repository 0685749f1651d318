// What can be pressed of a surface that no repair closes: one side of it, as a solid.
#pragma once

#include <string>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// How far the solid is from what is seen of the mesh.
struct SideError {
  double spacing_m = 0.0;  // of the grid taken
  double mean_m = 0.0;
  double max_m = 0.0;
};

/// The mesh as seen from `side`: highest points on a grid, joined where neighbours have one, with walls down to a
/// flat back behind the mesh. Always closed (several sheets may meet in one edge); undercuts are filled. Grids beyond
/// 600 points along the longer side are widened. The error is the distance of visible points, between those of the
/// grid, to the solid: at most about one spacing beside walls.
/// \throw DataError if the side shows no area
TriangleMesh solid_of_side(const TriangleMesh& mesh, const std::string& side, double spacing_m, SideError& error);

}  // namespace tacipc
