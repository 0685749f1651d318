// The surfaces that may touch, in one vertex numbering: gel vertices first, the object's after them.
#pragma once

#include <array>
#include <vector>

#include "common/base/types.h"

namespace tacipc {

/// Vertices, edges and triangles of one surface, in combined vertex indices.
struct Surface {
  std::vector<int> vertices;              // ascending
  std::vector<std::array<int, 2>> edges;  // each once, lower index first, ascending
  std::vector<std::array<int, 3>> triangles;
};

/// Collects the primitives of a surface whose vertex indices are shifted by `offset`.
Surface make_surface(const Triangles& triangles, int offset);

/// What contact needs to know of gel and object. Positions are passed beside it, #gel + #object rows.
struct ContactMesh {
  int num_gel_vertices = 0;
  int num_object_vertices = 0;
  Surface gel;
  Surface object;
  Positions rest_positions;  // all vertices, gel undeformed; scale of the edge mollifier and of close pairs at rest
  std::vector<double> object_edge_sharpness;  // of object.edges, as the object was given (contact/sharpness.h)

  int num_vertices() const { return num_gel_vertices + num_object_vertices; }
};

ContactMesh make_contact_mesh(const Positions& gel_rest, const Triangles& gel_boundary, const Positions& object,
                              const Triangles& object_triangles);

}  // namespace tacipc
