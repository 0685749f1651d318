// A press as one binary glTF 2.0 file, for Blender and viewers: the front over time and the object that moves.
#pragma once

#include <string>
#include <vector>

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/press_folder.h"

namespace tacipc {

/// The bytes of a .glb file, little-endian. A root node turns frame S (z up here) to the y-up axes of glTF; below it,
/// in metres and in single precision,
/// - `gel`: the front face at rest, with a morph target for every later frame (how far each vertex has moved), colours
///   of the indentation in the last frame as in the report's pictures, and no normals: viewers must make their own,
///   which are right in every frame;
/// - `object`: the mesh in its own frame; the node has the pose.
/// One animation plays both at the press's times, linearly between the frames. A press with one frame has none.
/// Same press, same bytes. \throw DataError if the file would exceed 4 GiB
std::string glb_bytes(const TetMesh& gel, const TriangleMesh& object, const PressFolder& press);

}  // namespace tacipc
