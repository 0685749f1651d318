// Meshes of formats that state their unit: binary and text glTF (.glb, .gltf), 3MF (.3mf).
#pragma once

#include <filesystem>
#include <string>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

struct SceneMesh {
  TriangleMesh mesh;  // in `unit`
  std::string unit;   // m, cm, mm, um, in or ft
};

bool is_scene_file(const std::filesystem::path& path);

/// All triangles at their places: of the build of a 3MF file but its supports, and of one scene of a glTF file, at
/// rest. A glTF file must hold its buffers itself. \throw DataError `FILE: …` for files it cannot read, that have no
/// triangles or vertices that are not finite.
SceneMesh read_scene_file(const std::filesystem::path& path);

}  // namespace tacipc
