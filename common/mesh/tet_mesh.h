// A tetrahedral mesh of a gel, or of a soft object, with its tagged boundary, and its files (Gmsh MSH).
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// What a boundary triangle is: front, side or glued of a gel; free all over a soft object, which nothing holds. The
/// numbers are the physical tags in the MSH file, where 4 is the volume.
enum class BoundaryTag { front = 1, side = 2, glued = 3, free = 5 };

/// Tetrahedral mesh in metres; tets are positively oriented; boundary triangles look outwards.
struct TetMesh {
  Positions positions;            // #V × 3
  Tetrahedra tets;                // #T × 4
  Triangles boundary;             // #B × 3, every boundary triangle exactly once
  std::vector<BoundaryTag> tags;  // #B

  Eigen::Index num_vertices() const { return positions.rows(); }
  Eigen::Index num_tets() const { return tets.rows(); }
  /// Boundary triangles of one kind, in boundary order.
  Triangles faces(BoundaryTag tag) const;
  /// Vertices of the faces of one kind, ascending.
  std::vector<int> vertices(BoundaryTag tag) const;
  /// The faces of one kind as a surface of its own: by places in vertices(tag).
  Triangles surface(BoundaryTag tag) const;
};

/// Several meshes as one: the vertices of the first, then those of the second, …; tets and boundary likewise.
TetMesh joined(const std::vector<TetMesh>& meshes);

/// Outward triangles that belong to exactly one tet, in the order of the tets. \throw DataError if three tets share a
/// face.
Triangles boundary_triangles(const Tetrahedra& tets, Eigen::Index num_vertices);

/// Nodes, tets and triangles of a Gmsh file as it stands (2.2 and 4.1, text and binary of either byte order), in the
/// file's node order and unit, whatever the node numbers are.
struct MshContent {
  Positions positions;
  Tetrahedra tets;
  Triangles triangles;
  std::vector<int> triangle_tags;  // physical tag, 0 if none
};
/// \throw DataError naming file and place for truncated, corrupt or unsupported content (higher-order tets are named as
/// such).
MshContent read_msh(const std::filesystem::path& path);

/// Writes a tagged mesh as MSH 4.1 ASCII (numbers read back to the same bits; physical groups front, side, glued and
/// gel, or free and object), readable by Gmsh and by read_msh. Boundary triangles are grouped by tag, in boundary order
/// within each.
void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh);
/// Reads the gel that write_tet_mesh wrote. \throw DataError if a tag is missing (a side alone may be), a tet is not
/// positive, the boundary does not fit the tets, or it is a soft object.
TetMesh read_tet_mesh(const std::filesystem::path& path);
/// Reads a soft object likewise. \throw DataError the same, or if it is a gel.
TetMesh read_object_tet_mesh(const std::filesystem::path& path);

}  // namespace tacipc
