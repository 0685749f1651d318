// Meshes at their places in a file, joined to one: the common end of readers whose files place meshes (glTF, 3MF).
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh/scene_file.h"

namespace tacipc {

/// A mesh as a file lists it. \pre triangles name vertices that there are
struct PartMesh {
  std::vector<Vector3> vertices;
  std::vector<Eigen::Vector3i> triangles;
};

/// Where a file puts a mesh; the mesh outlives it.
struct PlacedPart {
  const PartMesh* mesh;
  Eigen::Affine3d scene_from_part;
};

/// Limits to what a small file can ask for by naming one mesh many times, or placements inside placements.
inline constexpr std::size_t kMostSceneElements = 16'000'000;  // vertices, and triangles
inline constexpr std::size_t kMostPlacements = 1'000'000;
inline constexpr int kDeepestPlacement = 64;

/// All parts in one mesh; triangles of mirrored parts keep looking outwards. \throw DataError `NAME: …` if there is no
/// triangle, a vertex is not finite, or there are too many of either.
TriangleMesh joined_parts(std::span<const PlacedPart> parts, const std::string& name);

/// The readers behind read_scene_file; `name` is the file's, for messages.
SceneMesh read_3mf(std::string_view bytes, const std::string& name);
SceneMesh read_gltf(std::string_view bytes, const std::string& name);

}  // namespace tacipc
