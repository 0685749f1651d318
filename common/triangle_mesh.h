// A triangle mesh and its files: STL (binary, ASCII), OBJ, OFF, PLY in; binary PLY out.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/types.h"

namespace tacipc {

struct TriangleMesh {
  Positions positions;  // #V × 3, metres
  Triangles triangles;  // #F × 3, counter-clockwise seen from outside

  Eigen::Index num_vertices() const { return positions.rows(); }
  Eigen::Index num_triangles() const { return triangles.rows(); }
};

/// What a file's numbers mean: metres per unit.
double metres_per_unit(const std::string& unit);  // "m", "cm", "mm", "um", "in"; \throw UsageError otherwise

/// Reads a surface by the file's suffix (.stl .obj .off .ply, any case) and scales it to metres. Polygons are split
/// into triangles (fan from the first vertex for triangles and quads, ear clipping for concave polygons); STL corners
/// with equal bits become one vertex; vertex order of indexed formats is kept. \throw DataError `FILE:LINE: …` (text)
/// or `FILE: … at byte N` (binary) for truncated, corrupt or empty files, indices out of range, non-finite numbers.
TriangleMesh read_triangle_mesh(const std::filesystem::path& path, double metres_per_unit);

/// Binary little-endian PLY with double coordinates in metres. \throw DataError if it cannot be written.
void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace tacipc
