// Placement of an object over the gel: side that presses, rotation, position.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Returns the names of an object's sides: +x -x +y -y +z -z.
const std::vector<std::string>& face_names();

/// Returns the side that faces down if `up` points up: "-z" for "+z".
std::string opposite_face(const std::string& up);

/// Placement of an object.
struct Placement {
  std::string face = "-z";  // side of the object that presses into the gel
  double rotate_rad = 0.0;  // angle about z of S, from x towards y
  double center_x_m = 0.0;  // position on the gel of the centre of the object's bounding box
  double center_y_m = 0.0;
};

/// Returns gel_from_object with the object's lowest point at height `lowest_z_m` above the plane z = 0 of S. The face
/// is turned towards −z by the smallest rotation (+z: by 180° about x); then the object is rotated about z, then
/// shifted.
Matrix4 place(const Positions& object_positions, const Placement& placement, double lowest_z_m);

/// Returns `positions` mapped by a rigid transform, row by row.
Positions transformed(const Matrix4& target_from_source, const Positions& positions);

}  // namespace tacipc
