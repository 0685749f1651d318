// Surfaces that may touch, in one vertex numbering: gel vertices first, then vertices of rigid objects.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "common/base/types.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/gel/press/contact/shape_features.h"
#include "stages/gel/press/contact/surface.h"

namespace tacipc {

struct ContactMesh;

/// One of several gels and soft objects: consecutive rows of the mesh, and the body alone in its own frame.
struct GelPart {
  int first_vertex = 0;
  int anchor = 0;  // index within the body of a vertex of its mount; −1 for a body without a mount
  std::shared_ptr<const ContactMesh> mesh;  // undeformed body alone, a gel's front up
};

/// One of the rigid objects: consecutive rows of the mesh.
struct ObjectPart {
  int first_vertex = 0;
  Surface surface;
  int num_vertices = 0;
  auto rows(auto& x) const { return x.middleRows(first_vertex, num_vertices); }
  bool has(int vertex) const { return vertex >= first_vertex && vertex < first_vertex + num_vertices; }
};

/// Geometry of gels and objects for contact. Positions are passed separately, with rows for gel vertices, object
/// vertices, and control points of bodies that may be free (energy/affine_body.h).
struct ContactMesh {
  int num_gel_vertices = 0;
  int num_object_vertices = 0;
  int num_control_points = 0;
  Surface gel;
  Surface object;
  Positions rest_positions;  // all vertices, gel undeformed; scale of the edge mollifier and of close pairs at rest
  std::vector<double> object_edge_sharpness;  // per edge of `object`, as the object was given (contact/sharpness.h)
  /// Sharpness per edge of `gel`; nonzero only for soft objects, which may have sharp edges.
  std::vector<double> gel_edge_sharpness;
  /// Features of `object` if there are several objects. Empty for a single object, which touches nothing rigid.
  ShapeFeatures object_shapes;
  std::vector<GelPart> gels;  // parts if there are several gels; empty for a single gel
  /// Rigid objects. Those that may be free come first, in the order of their control points.
  std::vector<ObjectPart> objects;

  int num_vertices() const { return num_gel_vertices + num_object_vertices; }
  int num_rows() const { return num_vertices() + num_control_points; }
  /// Rows of the object vertices.
  auto object_rows(auto& x) const { return x.middleRows(num_gel_vertices, num_object_vertices); }
  /// Rows of the control points.
  auto control_rows(auto& x) const { return x.middleRows(num_vertices(), num_control_points); }

  /// First of the four rows of control points of the body with index `body`.
  int control_row(int body) const { return num_vertices() + 4 * body; }

  int num_gels() const { return gels.empty() ? 1 : static_cast<int>(gels.size()); }
  int num_bodies() const { return num_gels() + static_cast<int>(objects.size()); }
  /// Index of the body of a vertex: gels in their order, then objects.
  int body_of(int vertex) const;
};

/// Mesh of one gel, or of several whose rows follow one another, and any number of objects.
ContactMesh make_contact_mesh(const Positions& gel_rest, const Triangles& gel_boundary,
                              const std::vector<TriangleMesh>& objects);

}  // namespace tacipc
