// The surfaces that may touch, in one vertex numbering: gel vertices first, the object's after them.
#pragma once

#include <array>
#include <memory>
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

struct ContactMesh;

/// One of several gels and soft objects: neighbouring rows of the whole, and the body alone in a frame of its own.
struct GelPart {
  int first_vertex = 0;
  int anchor = 0;                           // a vertex of its mount, by its own number; −1 for a body without a mount
  std::shared_ptr<const ContactMesh> mesh;  // of this body, undeformed, a gel's front up
};

/// What contact needs to know of gel and object. Positions are passed beside it: rows of the gel, of the object, and of
/// points that carry the object where it moves freely (energy/affine_body.h).
struct ContactMesh {
  int num_gel_vertices = 0;
  int num_object_vertices = 0;
  int num_control_points = 0;
  Surface gel;
  Surface object;
  Positions rest_positions;  // all vertices, gel undeformed; scale of the edge mollifier and of close pairs at rest
  std::vector<double> object_edge_sharpness;  // of object.edges, as the object was given (contact/sharpness.h)
  std::vector<GelPart> gels;                  // where there are several; else all of the gel is one

  int num_vertices() const { return num_gel_vertices + num_object_vertices; }
  int num_rows() const { return num_vertices() + num_control_points; }
  /// The object's rows of positions.
  auto object_rows(auto& x) const { return x.middleRows(num_gel_vertices, num_object_vertices); }
  /// Those of the points that carry it.
  auto control_rows(auto& x) const { return x.middleRows(num_vertices(), num_control_points); }
};

ContactMesh make_contact_mesh(const Positions& gel_rest, const Triangles& gel_boundary, const Positions& object,
                              const Triangles& object_triangles);

}  // namespace tacipc
