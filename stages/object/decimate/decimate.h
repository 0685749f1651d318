// Quadric edge collapse of a closed surface.
#pragma once

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

struct CollapseConfig {
  int target_vertices = 8000;
  double max_normal_change_deg = 60.0;  // of a face, by one collapse
  double max_aspect_ratio = 20.0;       // longest edge over the height on it, unless the face was worse before
};

struct CollapseReport {
  bool passed_through = false;  // already small enough
  int retries = 0;              // with more vertices, because the surface crossed itself
  int target_vertices = 0;      // of the last try
};

/// Collapses edges of least quadric error, each onto one of its ends, so that the vertices left are vertices of the
/// input, in their order [Garland1997]. Every edge keeps two faces, no face is turned over. A mesh of at most the
/// target's vertices is returned as it is. If `may_not_cross` and the result crosses itself, more vertices are allowed,
/// half as many again each time. \pre the mesh is closed, oriented and manifold, as treat_mesh leaves it.
/// \throw DataError if no number of vertices avoids a crossing.
TriangleMesh collapse_edges(const TriangleMesh& mesh, const CollapseConfig& config, bool may_not_cross,
                            CollapseReport& report);

}  // namespace tacipc
