// Improves the shape of tetrahedra by moving inner vertices; the surface stays unchanged.
#pragma once

#include "common/mesh/tet_mesh.h"

namespace tacipc {

/// Smallest sine of a dihedral angle: 0 for a flat tetrahedron, √8/3 for a regular one, negative for an inverted one.
double smallest_dihedral_sine(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Moves each vertex that lies on no boundary triangle if this improves the worst shape among its tetrahedra
/// (`smallest_dihedral_sine`): towards the middle of its neighbours, or away from the face of its worst tetrahedron.
/// Vertices are visited in order, `sweeps` times. No tetrahedron gets worse than the worst around the vertex was, so
/// none inverts. After the idea of Freitag and Ollivier-Gooch, Tetrahedral Mesh Improvement Using Swapping and
/// Smoothing, 1997.
void smooth(TetMesh& mesh, int sweeps);

}  // namespace tacipc
