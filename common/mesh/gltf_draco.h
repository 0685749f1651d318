// Meshes that a glTF file compresses with Draco.   [KHR_draco_mesh_compression]
#pragma once

#include <string>

#include "common/mesh/gltf_file.h"

namespace tacipc {

/// Decompresses a primitive into arrays that it adds to the file, and names these instead. \pre primitive.draco
/// \throw DataError `NAME: …`
GltfPrimitive decompressed(GltfPrimitive primitive, GltfFile& file, const std::string& name);

}  // namespace tacipc
