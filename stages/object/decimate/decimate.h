// Quadric edge collapse of a closed surface.
#pragma once

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Settings of the collapse.
struct CollapseConfig {
  int target_vertices = 8000;
  double max_normal_change_deg = 60.0;  // largest change of a face normal by one collapse
  double max_aspect_ratio = 20.0;       // longest edge over its height; does not apply to faces that were worse before
};

/// Course of the collapse, for the record.
struct CollapseReport {
  bool passed_through = false;  // the mesh was already small enough
  int retries = 0;              // number of repetitions with more vertices because the surface crossed itself
  int target_vertices = 0;      // target of the last attempt
};

/// Collapses the edges of least quadric error, each onto one of its ends. The remaining vertices are vertices of the
/// input, in their order [Garland1997]. Every edge keeps two faces, and no face is turned over. A mesh that already
/// meets the target is returned unchanged. If `may_not_cross` is set and the result crosses itself, the target grows by
/// half and the collapse is repeated.
/// \pre the mesh is closed, oriented and manifold, as treat_mesh leaves it
/// \throw DataError if no number of vertices avoids a crossing
TriangleMesh collapse_edges(const TriangleMesh& mesh, const CollapseConfig& config, bool may_not_cross,
                            CollapseReport& report);

}  // namespace tacipc
