// One frame of a press as grids: the gel's surface, its volume, the object.
#pragma once

#include "common/triangle_mesh.h"
#include "stages/export/press_folder.h"
#include "stages/export/vtu.h"

namespace tacipc {

/// All boundary triangles of the gel and the vertices they use, where they are in this frame. Points: displacement from
/// the undeformed gel (m), normal_force and friction_force on the gel (N), contact_state (0 none, 1 stick, 2 slip), the
/// last three zero off the front. Cells: boundary (1 front, 2 side, 3 glued).
VtuGrid surface_grid(const TetMesh& gel, const PressArrays& press, std::size_t frame);

/// The tetrahedra. Points: displacement, normal_force, friction_force. Cells: volume_ratio, deformed over undeformed
/// volume.
VtuGrid volume_grid(const TetMesh& gel, const PressArrays& press, std::size_t frame);

/// The object's triangles where the frame's pose puts them.
VtuGrid object_grid(const TriangleMesh& object, const PressArrays& press, std::size_t frame);

}  // namespace tacipc
