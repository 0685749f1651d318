// Generates a soft object from its closed surface.
#pragma once

#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/gel/tetmesh/generate.h"

namespace tacipc {

/// Fills the surface with tetrahedra and checks them, as generate_gel() does. Vertices of the surface come first; they
/// and its triangles stay unchanged, except that vertices without a triangle are dropped. Every boundary triangle is
/// `free`. Inside, edges grow to the sizing's single length.
/// \throw UsageError for a graded sizing
/// \throw DataError for a surface that is open, in several pieces, faces inwards or intersects itself, for too many
/// vertices, and for a mesh that fails the checks
TetMesh mesh_object(TriangleMesh surface, const GenerateConfig& config);

}  // namespace tacipc
