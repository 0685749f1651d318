// Converts one frame of a press to grids: the gel's surface, its volume, the object.
#pragma once

#include <span>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/press_folder.h"
#include "stages/gel/export/vtu.h"

namespace tacipc {

/// Renumbers indices so that unused vertices are dropped. \return the vertices in use, ascending
std::vector<int> drop_unused(std::span<int> indices);

/// Grid of all boundary triangles of the gel and their vertices in this frame. Points: displacement from the undeformed
/// gel (m), normal_force and friction_force on the gel (N), contact_state (a ContactState); the last three are zero off
/// the front. If the press has stress, also pressure and shear of the contact (Pa). Cells: boundary (1 front, 2 side, 3
/// glued).
VtuGrid surface_grid(const TetMesh& gel, const PressFolder& press, std::size_t frame);

/// Grid of the tetrahedra. Points: displacement, normal_force, friction_force. Cells: volume_ratio (deformed /
/// undeformed volume) and, if the press has it, stress (Cauchy, Pa, xx yy zz xy yz xz in the order of VTK).
VtuGrid volume_grid(const TetMesh& gel, const PressFolder& press, std::size_t frame);

/// Grid of the tetrahedra of a soft body with its vertices at `x`. Points: displacement since frame 0, with vertices at
/// `first`. Cells: volume_ratio, relative to the volume at rest.
VtuGrid soft_grid(const TetMesh& soft, const Positions& first, const Positions& x);

/// Grid of the object's triangles at a pose.
VtuGrid object_grid(const TriangleMesh& object, const Matrix4& world_from_object);

/// Transforms a grid to the world: its points, all arrays of three components and all tensors.
VtuGrid in_world(VtuGrid grid, const Matrix4& world_from_gel);

}  // namespace tacipc
