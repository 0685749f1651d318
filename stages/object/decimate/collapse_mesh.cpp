#include "stages/object/decimate/collapse_mesh.h"

#include <algorithm>
#include <array>

#include "common/base/error.h"

namespace tacipc {

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

void CollapseMesh::build(const std::vector<OpenMesh::Vec3d>& points, const Triangles& triangles) {
  clean();
  const auto num_faces = static_cast<std::size_t>(triangles.rows());
  reserve(points.size(), 3 * num_faces / 2, num_faces);
  for (const OpenMesh::Vec3d& point : points) set_point(new_vertex(), point);
  // Edges by their first vertex, as linked lists: the last edge found at each vertex, and for each edge the previous
  // one.
  constexpr int kNone = -1;
  std::vector<int> last(points.size(), kNone), before;
  const auto halfedge_between = [&](int a, int b, Eigen::Index f) {
    const int low = std::min(a, b), high = std::max(a, b);
    int e = last[low];
    while (e != kNone && to_vertex_handle(halfedge_handle(EdgeHandle(e), 0)).idx() != high) e = before[e];
    const bool known = e != kNone;
    if (!known) {
      e = edge_handle(new_edge(VertexHandle(low), VertexHandle(high))).idx();
      before.push_back(last[low]);
      last[low] = e;
    }
    const HalfedgeHandle h = halfedge_handle(EdgeHandle(e), a < b ? 0U : 1U);
    if (face_handle(h).is_valid()) throw DataError("face {} cannot be added: the mesh is not manifold there", f);
    return h;
  };
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    std::array<HalfedgeHandle, 3> sides;
    const FaceHandle face = new_face();
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      sides[k] = halfedge_between(a, b, f);
      set_face_handle(sides[k], face);
      set_halfedge_handle(VertexHandle(a), sides[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) set_next_halfedge_handle(sides[k], sides[(k + 1) % 3]);
    set_halfedge_handle(face, sides[2]);  // last halfedge, so that corners are read from the first
  }
  for (unsigned h = 0; h < n_halfedges(); ++h) {
    if (!face_handle(HalfedgeHandle(static_cast<int>(h))).is_valid())
      throw DataError("the edge of vertices {} and {} has one face only",
                      from_vertex_handle(HalfedgeHandle(static_cast<int>(h))).idx(),
                      to_vertex_handle(HalfedgeHandle(static_cast<int>(h))).idx());
  }
  check_fans(triangles);
}

void CollapseMesh::check_fans(const Triangles& triangles) const {
  std::vector<unsigned> corners(n_vertices(), 0);
  for (Eigen::Index i = 0; i < triangles.size(); ++i) ++corners[triangles.data()[i]];
  for (const auto v : vertices()) {
    if (valence(v) != corners[v.idx()])
      throw DataError("several sheets meet in vertex {}: the mesh is not manifold there", v.idx());
  }
}

bool CollapseMesh::is_collapse_ok(HalfedgeHandle h) {
  const HalfedgeHandle o = opposite_halfedge_handle(h);
  const VertexHandle gone = from_vertex_handle(h), kept = to_vertex_handle(h);
  if (status(edge_handle(h)).deleted() || status(gone).deleted() || status(kept).deleted()) return false;
  if (is_boundary(h) || is_boundary(o)) return false;
  const VertexHandle left = to_vertex_handle(next_halfedge_handle(h));
  const VertexHandle right = to_vertex_handle(next_halfedge_handle(o));
  if (left == right) return false;
  seen_.resize(n_vertices(), 0);
  ++question_;
  for (auto v = cvv_iter(kept); v.is_valid(); ++v) seen_[v->idx()] = question_;
  for (auto v = cvv_iter(gone); v.is_valid(); ++v) {
    if (seen_[v->idx()] == question_ && *v != left && *v != right) return false;
  }
  return true;
}

void CollapseMesh::merge_edges(HalfedgeHandle kept, HalfedgeHandle gone) {
  const HalfedgeHandle replaced = opposite_halfedge_handle(gone);
  const FaceHandle beyond = face_handle(replaced);
  set_next_halfedge_handle(kept, next_halfedge_handle(replaced));
  set_next_halfedge_handle(prev_halfedge_handle(replaced), kept);
  set_face_handle(kept, beyond);
  if (halfedge_handle(beyond) == replaced) set_halfedge_handle(beyond, kept);
  // The corner opposite to the collapsed edge may have referred to the edge that is removed.
  for (const HalfedgeHandle h : {gone, replaced}) {
    const VertexHandle v = from_vertex_handle(h);
    if (halfedge_handle(v) == h) set_halfedge_handle(v, h == replaced ? kept : opposite_halfedge_handle(kept));
  }
  status(edge_handle(gone)).set_deleted(true);
}

void CollapseMesh::collapse(HalfedgeHandle h) {
  const HalfedgeHandle o = opposite_halfedge_handle(h);
  const VertexHandle gone = from_vertex_handle(h), kept = to_vertex_handle(h);
  const HalfedgeHandle after_h = next_halfedge_handle(h), before_h = prev_halfedge_handle(h);
  const HalfedgeHandle after_o = next_halfedge_handle(o), before_o = prev_halfedge_handle(o);
  for (const HalfedgeHandle side : {h, o}) status(face_handle(side)).set_deleted(true);
  for (auto in = vih_iter(gone); in.is_valid(); ++in) set_vertex_handle(*in, kept);
  set_halfedge_handle(kept, after_h);
  merge_edges(after_h, before_h);  // left: kept → corner
  merge_edges(before_o, after_o);  // right: corner → kept
  status(edge_handle(h)).set_deleted(true);
  status(gone).set_deleted(true);
  set_isolated(gone);
}

}  // namespace tacipc
