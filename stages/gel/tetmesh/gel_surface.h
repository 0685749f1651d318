// Closed, tagged surface of a gel: front and glued face, joined by rows of points down the side.
#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "stages/gel/tetmesh/sizing.h"

namespace tacipc {

/// A closed surface with a tag per triangle.
struct GelSurface {
  Positions positions;            // metres, frame S: first the front's vertices, each on its analytic height
  Triangles triangles;            // facing outwards
  std::vector<BoundaryTag> tags;  // one per triangle
};

/// Triangulates the surface of the gel at the target edge lengths. The rim is inscribed: its vertices lie on the
/// outline, its edges are chords.
/// \throw DataError if the rim is not closed
GelSurface gel_surface(const Sizing& sizing, std::uint64_t seed);

}  // namespace tacipc
