// Wraps a mesh that no repair closes, and measures the distance between both.
#pragma once

#include "common/base/value.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/object.h"

namespace tacipc {

/// Result of wrap.
struct WrappedObject {
  TriangleMesh mesh;
  Value::Map summary;  // lines for the record; lengths in mm
};

/// Wraps and measures: the distance of the wrap's vertices and face centres from the mesh, and the distance of the mesh
/// visible from the six sides from the wrap.
/// \throw DataError if alpha is too fine or too coarse for the mesh, or as alpha_wrap
WrappedObject wrap_object(const TriangleMesh& mesh, const WrapConfig& config);

/// Object file of the wrap of a mesh with this object file: in metres, at the final size, without a wrap section.
ObjectSpec spec_of_wrapped(ObjectSpec spec);

}  // namespace tacipc
