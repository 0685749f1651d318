// Closed surfaces with known sizes, in metres.
#pragma once

#include "tests/make_mesh.h"

namespace tacipc {

/// Cube [0, size]³, each side a grid of n × n squares.
TriangleMesh cube(double size_m, int n = 1);

/// Torus about z of nu × nv vertices whose tube radius is `tube (1 + bump sin(a u) sin(b v))`.
TriangleMesh bumpy_torus(double ring_m, double tube_m, double bump, int nu, int nv);

/// Both meshes as one, without merging anything.
TriangleMesh joined(const TriangleMesh& first, const TriangleMesh& second);
TriangleMesh moved(TriangleMesh mesh, const Vector3& by_m);
TriangleMesh without_faces(const TriangleMesh& mesh, const std::vector<int>& faces);
TriangleMesh with_face(const TriangleMesh& mesh, const std::array<int, 3>& face);
TriangleMesh with_face_turned(TriangleMesh mesh, int face);

/// Every edge in two faces of opposite direction and one fan of faces around each vertex.
bool is_closed_manifold(const TriangleMesh& mesh);

}  // namespace tacipc
