// Fills a closed surface with tetrahedra, by TetGen.
#pragma once

#include <functional>
#include <limits>

#include "stages/gel/tetmesh/gel_surface.h"

namespace tacipc {

/// Configuration of the fill.
struct FillConfig {
  double radius_edge_ratio = 0.0;   // largest circumradius / shortest edge; other tetrahedra are refined
  double circumradius_ratio = 0.0;  // largest circumradius / target edge length; other tetrahedra are refined
  double min_dihedral_deg = 0.0;    // target of the optimisation
  int optimization_level = 0;       // TetGen's 0 … 10
  int smoothing_sweeps = 0;         // sweeps over the inner vertices after the fill

  int max_vertices = std::numeric_limits<int>::max();  // stops unbounded refinement

  static FillConfig read(ConfigReader& in);
};

/// Fills the surface, whose triangles stay unchanged: its vertices come first, bit by bit, and new vertices lie inside.
/// \param edge_length_m target length at a point
/// \throw DataError with TetGen's reason if it fails
TetMesh fill_with_tets(const GelSurface& surface, const FillConfig& config,
                       const std::function<double(const Vector3&)>& edge_length_m);

}  // namespace tacipc
