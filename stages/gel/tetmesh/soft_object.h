// A soft object from its closed surface.
#pragma once

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/gel/tetmesh/generate.h"

namespace tacipc {

/// Fills the surface with tets and checks them, as generate_gel does. Vertices and triangles of the surface stay as
/// they are, but for vertices that no triangle names, and come first; every boundary triangle is `free`. Inside, edges
/// grow to the sizing's one length. \throw UsageError for a sizing that is graded as a gel's is; DataError for a
/// surface that is open, in several pieces, looks inwards or intersects itself, for too many vertices, and for a mesh
/// that fails the checks
TetMesh mesh_object(TriangleMesh surface, const GenerateConfig& config);

}  // namespace tacipc
