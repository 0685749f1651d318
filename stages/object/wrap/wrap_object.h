// A mesh that no repair closes, as the surface wrapped around it, with the distance between the two.
#pragma once

#include "common/base/value.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/object.h"

namespace tacipc {

struct WrappedObject {
  TriangleMesh mesh;
  Value::Map summary;  // for the record; lengths in mm
};

/// Wraps and measures: how far the wrap's vertices and face centres lie from the mesh, and what the six sides show of
/// the mesh from the wrap. \throw DataError if alpha is too fine or too coarse for the mesh, or as alpha_wrap.
WrappedObject wrap_object(const TriangleMesh& mesh, const WrapConfig& config);

/// The object file of what was made of a mesh with this one: metres, as large as wanted, nothing left to wrap.
ObjectSpec spec_of_wrapped(ObjectSpec spec);

}  // namespace tacipc
