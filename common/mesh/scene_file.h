// Reads meshes of formats that state their unit: binary and text glTF (.glb, .gltf), 3MF (.3mf).
#pragma once

#include <filesystem>
#include <string>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// A mesh and its unit.
struct SceneMesh {
  TriangleMesh mesh;  // coordinates in `unit`
  std::string unit;   // m, cm, mm, um, in or ft
};

/// Returns whether the suffix is one of these formats.
bool is_scene_file(const std::filesystem::path& path);

/// Reads all triangles at their positions: the build of a 3MF file without its supports, or one scene of a glTF file,
/// at rest. A glTF file must contain its buffers.
/// \throw DataError `FILE: …` if the file cannot be read, has no triangles, or has vertices that are not finite
SceneMesh read_scene_file(const std::filesystem::path& path);

}  // namespace tacipc
