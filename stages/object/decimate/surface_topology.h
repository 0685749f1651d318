// Adjacency of triangles at edges and vertices, from indices alone.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

/// Half edge h = 3 · face + k runs from corner k to corner k + 1 of its face.
inline int next_in_face(int half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
/// Vertices at the start and the end of a half edge.
inline int origin_of(const Triangles& triangles, int half_edge) { return triangles(half_edge / 3, half_edge % 3); }
inline int target_of(const Triangles& triangles, int half_edge) {
  return origin_of(triangles, next_in_face(half_edge));
}

/// A half edge as one use of its edge.
struct EdgeUse {
  int low, high;  // the two vertices
  int half_edge;
};

/// All half edges; those of one edge are adjacent, in ascending order of vertices and half edges.
std::vector<EdgeUse> edge_uses(const Triangles& triangles);

/// Calls visit(uses) with the uses of each edge.
template <typename Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit&& visit) {
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    while (last < uses.size() && uses[last].low == uses[first].low && uses[last].high == uses[first].high) ++last;
    visit(uses.subspan(first, last - first));
  }
}

/// Marks a half edge whose edge belongs to no other face.
inline constexpr int kOpen = -1;
/// Makes two half edges each other's opposite.
void pair_up(int a, int b, std::vector<int>& opposite);

/// Opposite half edge of each half edge, or kOpen. The two may run the same way where faces disagree about the outside.
/// \throw DataError, with the position, if more than two faces share an edge
std::vector<int> opposite_half_edges(const TriangleMesh& mesh);

/// Component of each face, and the number of components.
struct Components {
  std::vector<int> of_face;
  int count = 0;
};
/// Faces connected through edges; numbered in the order of their first faces.
Components connected_components(const Triangles& triangles, const std::vector<int>& opposite);

/// Appends faces to the mesh.
void append_faces(TriangleMesh& mesh, const std::vector<std::array<int, 3>>& faces);

/// Keeps the faces marked true, in order.
Triangles select_faces(const Triangles& triangles, const std::vector<char>& keep);

/// "(1.2, 3.4, 5.6) mm".
std::string place_mm(const Eigen::RowVector3d& point_m);

/// Extent along the longest axis of the box around the referenced vertices, m.
double largest_extent(const TriangleMesh& mesh);

/// Position of corner k of a face, m.
Vector3 corner(const TriangleMesh& mesh, int face, int k);
/// Area vector: normal times area, m².
Vector3 area_vector(const TriangleMesh& mesh, int face);
/// Area of the whole surface, m².
double surface_area(const TriangleMesh& mesh);

}  // namespace tacipc
