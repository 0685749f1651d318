// Joins placed meshes to one: the common last step of readers for glTF and 3MF.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh/scene_file.h"

namespace tacipc {

/// A mesh as a file lists it.
/// \pre indices of vertices are valid
struct PartMesh {
  std::vector<Vector3> vertices;
  std::vector<Eigen::Vector3i> triangles;
};

/// A mesh with its position in the scene; the mesh must outlive it.
struct PlacedPart {
  const PartMesh* mesh;
  Eigen::Affine3d scene_from_part;
};

/// Limits on the output of a small file that repeats one mesh many times, or nests placements.
inline constexpr std::size_t kMostSceneElements = 16'000'000;  // largest number of vertices, and of triangles
inline constexpr std::size_t kMostPlacements = 1'000'000;
inline constexpr int kDeepestPlacement = 64;

/// Joins all parts to one mesh; triangles of mirrored parts keep facing outwards.
/// \throw DataError `NAME: …` if there is no triangle, a vertex is not finite, or there are too many triangles or
/// vertices
TriangleMesh joined_parts(std::span<const PlacedPart> parts, const std::string& name);

/// Read the bytes of a file for read_scene_file(); `name` stands for the file in messages.
SceneMesh read_3mf(std::string_view bytes, const std::string& name);
SceneMesh read_gltf(std::string_view bytes, const std::string& name);

}  // namespace tacipc
