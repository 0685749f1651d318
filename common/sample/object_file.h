// Reads an object's mesh file in metres, and determines the unit of its numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/mesh/triangle_mesh.h"
#include "common/sample/object.h"

namespace tacipc {

/// A mesh and the unit of its file.
struct ObjectFile {
  TriangleMesh mesh;
  std::string unit;       // unit of the file's numbers: m, cm, mm, um, in, or ft
  std::string unit_from;  // source of the unit: "object file", "mesh format", "file name" or "default"
};

/// Returns the unit that ends a file name as its last word: `part_mm.stl`, `Part-inches.obj`, `part cm.ply`. Single
/// letters and "in" are not recognised, because they end too many other names.
std::optional<std::string> unit_in_name(const std::filesystem::path& path);

/// Reads a mesh in metres, scaled by `spec.scale`. Accepts the formats of read_triangle_mesh(), and glTF and 3MF, whose
/// files state their unit.
/// \throw DataError as read_triangle_mesh()
ObjectFile read_object_file(const std::filesystem::path& path, const ObjectSpec& spec);

}  // namespace tacipc
