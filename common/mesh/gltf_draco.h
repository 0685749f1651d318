// Decompresses Draco meshes of glTF files.   [KHR_draco_mesh_compression]
#pragma once

#include <string>

#include "common/mesh/gltf_file.h"

namespace tacipc {

/// Decompresses a primitive into arrays that it adds to `file`. Returns the primitive with these arrays.
/// \pre primitive.draco
/// \throw DataError `NAME: …` if the data are damaged
GltfPrimitive decompressed(GltfPrimitive primitive, GltfFile& file, const std::string& name);

}  // namespace tacipc
