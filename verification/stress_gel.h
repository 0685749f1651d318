// Coarse gels of the stress campaign.
#pragma once

#include "common/mesh/tet_mesh.h"
#include "common/sensor/sensor.h"
#include "verification/stress_config.h"

namespace tacipc::verify {

struct StressGel {
  GelShape shape;
  TetMesh mesh;
  double front_edge_m = 0.0;  // median edge of the front
};

/// Draws a rectangular or round gel with about as many vertices as drawn.
StressGel draw_gel(const StressConfig::Gel& ranges, double exact_share, Draws& draws);

/// Moves every vertex that lies on no edge and not on the glued face or a side by up to `part` of its shortest edge, in
/// the front face along it. A move that would leave a tetrahedron less than a quarter of its volume is not made.
void jitter_vertices(TetMesh& mesh, double part, Draws& draws);

}  // namespace tacipc::verify
