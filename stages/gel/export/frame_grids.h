// One frame of a press as grids: the gel's surface, its volume, the object.
#pragma once

#include <span>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/press_folder.h"
#include "stages/gel/export/vtu.h"

namespace tacipc {

/// Numbers vertices anew, without those that no index names. \return the vertices that are named, ascending
std::vector<int> drop_unused(std::span<int> indices);

/// All boundary triangles of the gel and the vertices they use, where they are in this frame. Points: displacement from
/// the undeformed gel (m), normal_force and friction_force on the gel (N), contact_state (a ContactState), the last
/// three zero off the front; where the press has stress also pressure and shear of the contact (Pa). Cells: boundary (1
/// front, 2 side, 3 glued).
VtuGrid surface_grid(const TetMesh& gel, const PressFolder& press, std::size_t frame);

/// The tetrahedra. Points: displacement, normal_force, friction_force. Cells: volume_ratio, deformed over undeformed
/// volume, and stress (Cauchy, Pa, xx yy zz xy yz xz as VTK has them) where the press has it.
VtuGrid volume_grid(const TetMesh& gel, const PressFolder& press, std::size_t frame);

/// The tetrahedra of a soft body with its vertices at `x`. Points: displacement since frame 0, where they were at
/// `first`. Cells: volume_ratio, to the volume at rest.
VtuGrid soft_grid(const TetMesh& soft, const Positions& first, const Positions& x);

/// The object's triangles where a pose puts them.
VtuGrid object_grid(const TriangleMesh& object, const Matrix4& world_from_object);

/// A grid whose points, and with them all arrays of three components and all tensors, are moved and turned into the
/// world.
VtuGrid in_world(VtuGrid grid, const Matrix4& world_from_gel);

}  // namespace tacipc
