// Better-shaped tets by moving the vertices inside; the surface stays as it is.
#pragma once

#include "common/mesh/tet_mesh.h"

namespace tacipc {

/// Smallest sine of a dihedral angle: 0 for a flat tet, √8/3 for a regular one, negative for an inverted one.
double smallest_dihedral_sine(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Moves each vertex that lies on no boundary triangle wherever this raises the worst shape among its tets
/// (`smallest_dihedral_sine`): towards the middle of its neighbours, or away from the face of its worst tet. Vertices
/// are visited in order, `sweeps` times; no tet gets worse than the worst around the vertex was, so none inverts.
/// After the idea of Freitag and Ollivier-Gooch, Tetrahedral Mesh Improvement Using Swapping and Smoothing, 1997.
void smooth(TetMesh& mesh, int sweeps);

}  // namespace tacipc
