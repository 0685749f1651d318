// A tetrahedral mesh of a gel or a soft object, with its tagged boundary, and its files (Gmsh MSH).
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Kind of a boundary triangle: front, side or glued on a gel; free on a soft object, which is not held. The numbers
/// are the physical tags in the MSH file; the volume has tag 4.
enum class BoundaryTag { front = 1, side = 2, glued = 3, free = 5 };

/// Tetrahedral mesh in metres. Tets are positively oriented; boundary triangles face outwards.
struct TetMesh {
  Positions positions;            // #V × 3
  Tetrahedra tets;                // #T × 4
  Triangles boundary;             // #B × 3, every boundary triangle exactly once
  std::vector<BoundaryTag> tags;  // #B

  Eigen::Index num_vertices() const { return positions.rows(); }
  Eigen::Index num_tets() const { return tets.rows(); }
  /// Returns the boundary triangles of one kind, in boundary order.
  Triangles faces(BoundaryTag tag) const;
  /// Returns the vertices of the faces of one kind, ascending.
  std::vector<int> vertices(BoundaryTag tag) const;
  /// Returns the faces of one kind with indices into vertices(tag).
  Triangles surface(BoundaryTag tag) const;
};

/// Joins several meshes to one: vertices of the first, then of the second, …; tets and boundary likewise.
TetMesh joined(const std::vector<TetMesh>& meshes);

/// Returns outward triangles that belong to exactly one tet, in the order of the tets.
/// \throw DataError if three tets share a face
Triangles boundary_triangles(const Tetrahedra& tets, Eigen::Index num_vertices);

/// Nodes, tets and triangles of a Gmsh file (2.2 and 4.1, text and binary of either byte order), in the file's node
/// order and unit, whatever the node numbers are.
struct MshContent {
  Positions positions;
  Tetrahedra tets;
  Triangles triangles;
  std::vector<int> triangle_tags;  // physical tag, 0 if none
};
/// Reads a Gmsh file.
/// \throw DataError naming file and location for truncated, corrupt or unsupported content; the message names
/// higher-order tets
MshContent read_msh(const std::filesystem::path& path);

/// Writes a tagged mesh as MSH 4.1 ASCII, readable by Gmsh and by read_msh(). Numbers read back to the same bits;
/// physical groups are front, side, glued and gel, or free and object. Boundary triangles are grouped by tag, in
/// boundary order within each.
void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh);
/// Reads a gel that write_tet_mesh() wrote.
/// \throw DataError if a tag is missing (except side), a tet is not positive, the boundary does not fit the tets, or
/// the mesh is a soft object
TetMesh read_tet_mesh(const std::filesystem::path& path);
/// Reads a soft object that write_tet_mesh() wrote.
/// \throw DataError as read_tet_mesh(), or if the mesh is a gel
TetMesh read_object_tet_mesh(const std::filesystem::path& path);

}  // namespace tacipc
