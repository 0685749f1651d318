// The reflecting membrane: the front face of the gel, deformed, as the camera behind it sees it.
#pragma once

#include <array>
#include <vector>

#include "common/base/types.h"
#include "common/mesh/tet_mesh.h"
#include "common/mesh/vertex_normals.h"

namespace tacipc {

/// Front face alone. Triangles look out of the gel (towards +z where it is flat), so from inside their backs show.
struct Membrane {
  Positions positions;                      // #V × 3, m, deformed
  Positions rest;                           // #V × 3, m, undeformed
  Positions normals;                        // #V × 3, unit, outward, of the deformed surface
  Triangles triangles;                      // #F × 3
  std::vector<std::array<int, 2>> outline;  // boundary edges in the direction of their triangle
  std::vector<int> gel_rows;                // rows of the gel's vertices that these are; empty if from plain arrays
};

/// Directed edges that occur in one triangle only, in triangle order.
std::vector<std::array<int, 2>> boundary_edges(const Triangles& triangles);

/// Closed loops that directed edges form.
int count_loops(const std::vector<std::array<int, 2>>& edges);

/// From plain arrays. \pre rest has as many rows as positions
Membrane make_membrane(Positions positions, Positions rest, Triangles triangles);

/// The front-tagged faces of a gel whose vertices moved to `deformed` (m, one row per gel vertex).
/// \throw DataError if the gel has no front face, or one that is not a single piece without holes.
Membrane make_membrane(const TetMesh& gel, const Eigen::Ref<const Positions>& deformed);

/// Takes the membrane to where the gel's vertices are now; triangles and outline stay. \pre made from that gel
void move_membrane(Membrane& membrane, const Eigen::Ref<const Positions>& deformed);

}  // namespace tacipc
