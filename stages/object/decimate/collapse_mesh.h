// Half-edge mesh whose edges collapse.
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

// After the mesh, whose traits it uses without including them.
#include <OpenMesh/Core/Geometry/QuadricT.hh>

#include <vector>

#include "common/mesh/triangle_mesh.h"

namespace tacipc {

struct CollapseTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
};

/// Closed triangle mesh. The decimater calls `is_collapse_ok` and `collapse` by name. OpenMesh's own versions do the
/// same, but Debian builds them with assertions that compare type names at each access, which takes more than half of
/// the time of a decimation.
class CollapseMesh : public OpenMesh::TriMesh_ArrayKernelT<CollapseTraits> {
 public:
  using Quadric = OpenMesh::Geometry::Quadricd;

  /// Builds the mesh from points and faces, in their order.
  /// \throw DataError if an edge is not between two faces of consistent orientation, or several sheets meet in one
  /// vertex
  void build(const std::vector<OpenMesh::Vec3d>& points, const Triangles& triangles);

  /// Link condition: the ends share no neighbours except the two corners opposite to the edge. Not for boundary edges.
  bool is_collapse_ok(OpenMesh::HalfedgeHandle h);
  /// Removes the origin of the halfedge, its edge and the adjacent faces.
  /// \pre is_collapse_ok(h)
  void collapse(OpenMesh::HalfedgeHandle h);

  /// Quadric of each vertex: sum of squared distances to the planes of its own faces and of the vertices merged into
  /// it.
  std::vector<Quadric> quadrics;

 private:
  void check_fans(const Triangles& triangles) const;
  /// Closes the gap of a removed face: its halfedge `kept` replaces the opposite of `gone`.
  void merge_edges(OpenMesh::HalfedgeHandle kept, OpenMesh::HalfedgeHandle gone);

  std::vector<unsigned> seen_;  // per vertex, the last query in which it was a neighbour
  unsigned question_ = 0;
};

}  // namespace tacipc
