// A triangle mesh, and its files: reads STL (binary, ASCII), OBJ, OFF and PLY; writes binary PLY.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// A triangle mesh in metres.
struct TriangleMesh {
  Positions positions;  // #V × 3, metres
  Triangles triangles;  // #F × 3, counter-clockwise seen from outside

  Eigen::Index num_vertices() const { return positions.rows(); }
  Eigen::Index num_triangles() const { return triangles.rows(); }
};

/// Makes positions or triangles from a list of their rows.
template <typename Matrix, typename Row>
Matrix rows_of(const std::vector<Row>& rows) {
  Matrix out(std::ssize(rows), 3);
  for (std::size_t i = 0; i < rows.size(); ++i) out.row(i) << rows[i][0], rows[i][1], rows[i][2];
  return out;
}

/// Units that a file's numbers may have.
inline const std::vector<std::string> kLengthUnits{"m", "cm", "mm", "um", "in"};
/// Returns metres per unit, for these units and for ft, which 3MF files may state.
/// \throw UsageError for other units
double metres_per_unit(const std::string& unit);

/// Reads a surface by the file's suffix (.stl .obj .off .ply, any case) and scales it to metres. Polygons are split
/// into triangles (a fan from the first corner of convex ones, ear clipping of concave ones). STL corners with equal
/// coordinates become one vertex; indexed formats keep their vertex order and unreferenced vertices.
/// \throw DataError `FILE:LINE: …` (text) or `FILE: … at byte N` (binary) for truncated, corrupt or empty files and
/// indices out of range; `FILE: vertex N is not finite` (counted from 0 in file order); `FILE: has no triangles`
TriangleMesh read_triangle_mesh(const std::filesystem::path& path, double metres_per_unit);

/// Returns Σ a · (b × c) / 6 over the triangles (a, b, c), m³: the volume inside a closed mesh, by the divergence
/// theorem. Positive if the triangles face outwards, negative if inwards; for an open mesh it depends on the origin and
/// is meaningless.
double signed_volume(const TriangleMesh& mesh);

/// Removes vertices that no triangle uses; the others keep their order.
void remove_unreferenced_vertices(TriangleMesh& mesh);

/// Writes binary little-endian PLY with double coordinates in metres.
/// \throw DataError if the file cannot be written
void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh);

}  // namespace tacipc
