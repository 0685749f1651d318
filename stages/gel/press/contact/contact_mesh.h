// The surfaces that may touch, in one vertex numbering: vertices of gels first, those of rigid objects after them.
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

/// One of several gels and soft objects: neighbouring rows of the whole, and the body alone in a frame of its own.
struct GelPart {
  int first_vertex = 0;
  int anchor = 0;                           // a vertex of its mount, by its own number; −1 for a body without a mount
  std::shared_ptr<const ContactMesh> mesh;  // of this body, undeformed, a gel's front up
};

/// One of the rigid objects: neighbouring rows of the whole.
struct ObjectPart {
  int first_vertex = 0;
  Surface surface;
  int num_vertices = 0;
  auto rows(auto& x) const { return x.middleRows(first_vertex, num_vertices); }
  bool has(int vertex) const { return vertex >= first_vertex && vertex < first_vertex + num_vertices; }
};

/// What contact needs to know of gels and objects. Positions are passed beside it: rows of the gels, of the objects,
/// and of points that carry those that may move freely (energy/affine_body.h).
struct ContactMesh {
  int num_gel_vertices = 0;
  int num_object_vertices = 0;
  int num_control_points = 0;
  Surface gel;
  Surface object;
  Positions rest_positions;  // all vertices, gel undeformed; scale of the edge mollifier and of close pairs at rest
  std::vector<double> object_edge_sharpness;  // of object.edges, as the object was given (contact/sharpness.h)
  std::vector<double> gel_edge_sharpness;     // of gel.edges, where a body that is no sensor's gel may have sharp ones
  /// Of `object`, where there are several objects: empty for one alone, which touches nothing rigid.
  ShapeFeatures object_shapes;
  std::vector<GelPart> gels;  // where there are several; else all of the gel is one
  /// Those that may move freely come first, in the order of their control points.
  std::vector<ObjectPart> objects;

  int num_vertices() const { return num_gel_vertices + num_object_vertices; }
  int num_rows() const { return num_vertices() + num_control_points; }
  /// The object's rows of positions.
  auto object_rows(auto& x) const { return x.middleRows(num_gel_vertices, num_object_vertices); }
  /// Those of the points that carry it.
  auto control_rows(auto& x) const { return x.middleRows(num_vertices(), num_control_points); }

  /// The first of the four points of the object that may move freely as number `body`.
  int control_row(int body) const { return num_vertices() + 4 * body; }

  int num_gels() const { return gels.empty() ? 1 : static_cast<int>(gels.size()); }
  int num_bodies() const { return num_gels() + static_cast<int>(objects.size()); }
  /// The body of a vertex: gels in their order, then objects.
  int body_of(int vertex) const;
};

/// Of a gel, or several whose rows follow one another, and any number of objects.
ContactMesh make_contact_mesh(const Positions& gel_rest, const Triangles& gel_boundary,
                              const std::vector<TriangleMesh>& objects);

}  // namespace tacipc
