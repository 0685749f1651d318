// The half-edge mesh whose edges collapse.
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

/// A closed triangle mesh. The decimater calls the two operations below by name; those of the library do the same, but
/// Debian builds it with assertions, which compare the names of types at each access: more than half of the time of a
/// decimation.
class CollapseMesh : public OpenMesh::TriMesh_ArrayKernelT<CollapseTraits> {
 public:
  using Quadric = OpenMesh::Geometry::Quadricd;

  /// Vertices with these points and faces with these corners, in their order. \throw DataError where an edge is not
  /// between two faces that look the same way, or several sheets meet in one vertex
  void build(const std::vector<OpenMesh::Vec3d>& points, const Triangles& triangles);

  /// Link condition: the ends have no neighbours in common but the two corners opposite to the edge. Not at boundaries.
  bool is_collapse_ok(OpenMesh::HalfedgeHandle h);
  /// Takes the vertex the halfedge comes from, its edge and the faces beside it out. \pre is_collapse_ok(h)
  void collapse(OpenMesh::HalfedgeHandle h);

  /// Σ of squared distances to planes, for each vertex: what it and those merged into it lay in.
  std::vector<Quadric> quadrics;

 private:
  void check_fans(const Triangles& triangles) const;
  /// Closes the gap of a face that is taken out: the halfedge `kept` of it takes the place of the opposite of `gone`.
  void merge_edges(OpenMesh::HalfedgeHandle kept, OpenMesh::HalfedgeHandle gone);

  std::vector<unsigned> seen_;  // by vertex: the last question in which it was a neighbour
  unsigned question_ = 0;
};

}  // namespace tacipc
