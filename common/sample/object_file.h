// An object's mesh file, in metres: which unit its numbers have.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/mesh/triangle_mesh.h"
#include "common/sample/object.h"

namespace tacipc {

struct ObjectFile {
  TriangleMesh mesh;
  std::string unit;       // of the file's numbers: m, cm, mm, um, in, or ft
  std::string unit_from;  // "object file", "mesh format", "file name" or "default"
};

/// The unit that a file's name states as its last word: `part_mm.stl`, `Part-inches.obj`, `part cm.ply`. Single letters
/// and "in" are words of too many names.
std::optional<std::string> unit_in_name(const std::filesystem::path& path);

/// Reads a mesh in metres, scaled by `spec.scale`: what read_triangle_mesh reads, and glTF and 3MF, whose formats state
/// their unit. \throw DataError as read_triangle_mesh.
ObjectFile read_object_file(const std::filesystem::path& path, const ObjectSpec& spec);

}  // namespace tacipc
