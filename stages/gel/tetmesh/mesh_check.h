// Checks that every generated or imported gel and every soft object must pass.
#pragma once

#include <string>

#include "common/mesh/tet_mesh.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Smallest and largest angle between two faces of a tetrahedron, degrees.
struct DihedralAngles {
  double smallest_deg;
  double largest_deg;
};
/// Dihedral angles of the tetrahedron abcd.
DihedralAngles dihedral_angles(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Checks that front, side and glued face each have a triangle. \throw DataError
void check_faces(const TetMesh& mesh, const std::string& name);

/// Checks the tetrahedra of a body:
/// - there are tetrahedra, all are positive (exactly), and no dihedral angle is below the limit;
/// - every vertex belongs to a tetrahedron, and neighbours agree on their face;
/// - the boundary is `mesh.boundary`, and each of its edges has two triangles.
/// \param name start of the error message
/// \throw DataError with numbers
void check_body(const TetMesh& mesh, double min_dihedral_deg, const std::string& name);

/// Limits of check_gel().
struct MeshLimits {
  double min_dihedral_deg = 0.0;
  double front_tolerance_m = 0.0;
};
/// Checks as check_body(), and that all three tags of a gel occur and front vertices lie on the sensor's front within
/// the tolerance (0: exactly).
/// \throw DataError with numbers
void check_gel(const TetMesh& mesh, const GelShape& gel, const MeshLimits& limits, const std::string& name);

}  // namespace tacipc
