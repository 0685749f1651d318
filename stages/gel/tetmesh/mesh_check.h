// Checks that every gel must pass, generated or imported, and every soft object.
#pragma once

#include <string>

#include "common/mesh/tet_mesh.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Smallest and largest angle between two faces of a tet, degrees.
struct DihedralAngles {
  double smallest_deg;
  double largest_deg;
};
DihedralAngles dihedral_angles(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

/// Checks that front, side and glued face each have a triangle. \throw DataError
void check_faces(const TetMesh& mesh, const std::string& name);

/// Checks that there are tets, that all are positive (exactly), no dihedral angle is below the limit, every vertex
/// belongs to a tet, neighbours agree on their face, the boundary is `mesh.boundary`, and each of its edges has two
/// triangles. \throw DataError with numbers; `name` opens the message
void check_body(const TetMesh& mesh, double min_dihedral_deg, const std::string& name);

/// Checks the same, and that all three tags of a gel occur, and front vertices lie on the sensor's front within the
/// tolerance (0: exactly). \throw DataError likewise
struct MeshLimits {
  double min_dihedral_deg = 0.0;
  double front_tolerance_m = 0.0;
};
void check_gel(const TetMesh& mesh, const GelShape& gel, const MeshLimits& limits, const std::string& name);

}  // namespace tacipc
