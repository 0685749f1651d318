// The reflecting membrane: the deformed front face of the gel, as the camera behind it sees it.
#pragma once

#include <array>
#include <vector>

#include "common/base/types.h"
#include "common/mesh/tet_mesh.h"
#include "common/mesh/vertex_normals.h"

namespace tacipc {

/// Front face alone. Triangles are oriented out of the gel (towards +z on the flat front), so the camera sees their
/// backs.
struct Membrane {
  Positions positions;                      // #V × 3, m, deformed
  Positions rest;                           // #V × 3, m, undeformed
  Positions normals;                        // #V × 3, unit, outward, of the deformed surface
  Triangles triangles;                      // #F × 3
  std::vector<std::array<int, 2>> outline;  // boundary edges, directed as in their triangle
  std::vector<int> gel_rows;  // rows of these vertices in the gel's positions; empty if made from plain arrays
};

/// Returns directed edges that occur in one triangle only, in triangle order.
std::vector<std::array<int, 2>> boundary_edges(const Triangles& triangles);

/// Returns the number of closed loops that directed edges form.
int count_loops(const std::vector<std::array<int, 2>>& edges);

/// Makes a membrane from plain arrays.
/// \pre rest has as many rows as positions
Membrane make_membrane(Positions positions, Positions rest, Triangles triangles);

/// Makes a membrane from the front-tagged faces of a gel whose vertices moved to `deformed` (m, one row per gel
/// vertex).
/// \throw DataError if the gel has no front face, or one that is not a single piece without holes.
Membrane make_membrane(const TetMesh& gel, const Eigen::Ref<const Positions>& deformed);

/// Moves the membrane to the gel's current vertices; triangles and outline stay.
/// \pre made from that gel
void move_membrane(Membrane& membrane, const Eigen::Ref<const Positions>& deformed);

}  // namespace tacipc
