// Tetrahedra inside a closed surface, by TetGen.
#pragma once

#include <functional>
#include <limits>

#include "stages/gel/tetmesh/gel_surface.h"

namespace tacipc {

struct FillConfig {
  double radius_edge_ratio = 0.0;   // tets with a longer circumradius over shortest edge are refined
  double circumradius_ratio = 0.0;  // and tets with a longer circumradius over the target edge length
  double min_dihedral_deg = 0.0;    // target of the optimisation
  int optimization_level = 0;       // TetGen's 0 … 10
  int smoothing_sweeps = 0;         // over the inner vertices, afterwards

  int max_vertices = std::numeric_limits<int>::max();  // from the limits: refinement without end stops here

  static FillConfig read(ConfigReader& in);
};

/// Fills the surface, whose triangles stay as they are: the surface's vertices come first, bit by bit; new vertices lie
/// inside. `edge_length_m` is the target length at a point. \throw DataError with TetGen's reason where it gives up.
TetMesh fill_with_tets(const GelSurface& surface, const FillConfig& config,
                       const std::function<double(const Vector3&)>& edge_length_m);

}  // namespace tacipc
