#include "stages/object/decimate/decimate.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModAspectRatioT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>

// After the mesh, whose traits it uses without including them.
#include <OpenMesh/Core/Geometry/QuadricT.hh>

#include <algorithm>
#include <vector>

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/object/decimate/self_intersection.h"

namespace tacipc {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::Normal);
};
using Mesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/// Quadric errors are kept as floats, which metres to the fourth power would leave.
constexpr double kUnitsPerMetre = 1e3;
constexpr double kMoreVertices = 1.5;
/// Normals of two faces that differ by more than 60 degrees meet in a crease.
constexpr double kCreaseCosine = 0.5;

/// The library's link condition lets a tetrahedron collapse into two faces back to back; this forbids it.
template <typename MeshT>
class ModKeepSolid : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(ModKeepSolid, MeshT, KeepSolid);
  explicit ModKeepSolid(MeshT& mesh) : Base(mesh, true) {}
  float collapse_priority(const CollapseInfo& info) override {
    const bool tetrahedron = Base::mesh().valence(info.vl) <= 3 && Base::mesh().valence(info.vr) <= 3;
    return tetrahedron ? float(Base::ILLEGAL_COLLAPSE) : float(Base::LEGAL_COLLAPSE);
  }
};

/// Cost of moving a vertex: Σ squared distance to the planes of all faces merged into either end [Garland1997]. Planes
/// count alike whatever their face's area, so that a step of narrow faces is worth as much as its height says.
template <typename MeshT>
class ModPlaneDistance : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(ModPlaneDistance, MeshT, PlaneDistance);
  explicit ModPlaneDistance(MeshT& mesh) : Base(mesh, false), quadrics_(mesh.n_vertices()) {}

  void initialize() override {
    const MeshT& mesh = Base::mesh();
    std::fill(quadrics_.begin(), quadrics_.end(), Quadric());
    for (auto face = mesh.faces_sbegin(); face != mesh.faces_end(); ++face) {
      const OpenMesh::Vec3d normal = mesh.normal(*face);
      const OpenMesh::Vec3d point = mesh.point(*mesh.cfv_iter(*face));
      const Quadric plane(normal, point);
      for (auto v = mesh.cfv_iter(*face); v.is_valid(); ++v) quadrics_[v->idx()] += plane;
    }
    for (auto edge = mesh.edges_sbegin(); edge != mesh.edges_end(); ++edge) add_crease(mesh.halfedge_handle(*edge, 0));
  }
  float collapse_priority(const CollapseInfo& info) override {
    Quadric both = quadrics_[info.v0.idx()];
    both += quadrics_[info.v1.idx()];
    return static_cast<float>(std::max(0.0, both(info.p1)));
  }
  void postprocess_collapse(const CollapseInfo& info) override { quadrics_[info.v1.idx()] += quadrics_[info.v0.idx()]; }

 private:
  using Quadric = OpenMesh::Geometry::Quadricd;

  /// Along a sharp edge, planes through it across both faces: without them the rim of a thin sheet, all of whose faces
  /// lie in one plane, could wander at no cost.
  void add_crease(OpenMesh::HalfedgeHandle h) {
    const MeshT& mesh = Base::mesh();
    const OpenMesh::Vec3d first = mesh.normal(mesh.face_handle(h));
    const OpenMesh::Vec3d second = mesh.normal(mesh.opposite_face_handle(h));
    if ((first | second) > kCreaseCosine) return;
    const OpenMesh::Vec3d edge = mesh.calc_edge_vector(h);
    for (const OpenMesh::Vec3d& normal : {first, second}) {
      OpenMesh::Vec3d across = edge % normal;
      if (across.norm() == 0.0) continue;
      const Quadric plane(across / across.norm(), mesh.point(mesh.from_vertex_handle(h)));
      quadrics_[mesh.from_vertex_handle(h).idx()] += plane;
      quadrics_[mesh.to_vertex_handle(h).idx()] += plane;
    }
  }

  std::vector<Quadric> quadrics_;
};

Mesh to_openmesh(const TriangleMesh& mesh) {
  Mesh out;
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    const Eigen::RowVector3d x = kUnitsPerMetre * mesh.positions.row(v);
    out.add_vertex({x[0], x[1], x[2]});
  }
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    const auto face = out.add_face(out.vertex_handle(static_cast<unsigned>(mesh.triangles(f, 0))),
                                   out.vertex_handle(static_cast<unsigned>(mesh.triangles(f, 1))),
                                   out.vertex_handle(static_cast<unsigned>(mesh.triangles(f, 2))));
    if (!face.is_valid()) throw DataError("face {} cannot be added: the mesh is not manifold there", f);
  }
  return out;
}

/// What is left, with the coordinates of the input bit by bit.
TriangleMesh remaining(const Mesh& collapsed, const TriangleMesh& input) {
  std::vector<int> new_index(static_cast<std::size_t>(input.num_vertices()), -1);
  std::vector<int> old_index;
  for (int v = 0; v < static_cast<int>(input.num_vertices()); ++v) {
    if (collapsed.status(collapsed.vertex_handle(static_cast<unsigned>(v))).deleted()) continue;
    new_index[v] = static_cast<int>(old_index.size());
    old_index.push_back(v);
  }
  std::vector<int> corners;
  for (int f = 0; f < static_cast<int>(input.num_triangles()); ++f) {
    const auto face = collapsed.face_handle(static_cast<unsigned>(f));
    if (collapsed.status(face).deleted()) continue;
    for (auto corner = collapsed.cfv_iter(face); corner.is_valid(); ++corner)
      corners.push_back(new_index[corner->idx()]);
  }
  TriangleMesh out;
  out.positions.resize(std::ssize(old_index), 3);
  for (std::size_t v = 0; v < old_index.size(); ++v)
    out.positions.row(static_cast<Eigen::Index>(v)) = input.positions.row(old_index[v]);
  out.triangles = Eigen::Map<const Triangles>(corners.data(), std::ssize(corners) / 3, 3);
  return out;
}

void collapse(Mesh& mesh, std::size_t target, const CollapseConfig& config, bool watch_shape) {
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  ModPlaneDistance<Mesh>::Handle distance;
  OpenMesh::Decimater::ModNormalFlippingT<Mesh>::Handle flipping;
  OpenMesh::Decimater::ModAspectRatioT<Mesh>::Handle shape;
  ModKeepSolid<Mesh>::Handle solid;
  decimater.add(distance);
  decimater.add(solid);
  decimater.add(flipping);
  decimater.module(flipping).set_max_normal_deviation(static_cast<float>(config.max_normal_change_deg));
  if (watch_shape) {
    decimater.add(shape);
    decimater.module(shape).set_aspect_ratio(static_cast<float>(config.max_aspect_ratio));
  }
  if (!decimater.initialize()) throw DataError("the edge collapse could not be set up");
  decimater.decimate_to(target);
}

std::size_t vertices_left(const Mesh& mesh) {
  std::size_t left = 0;
  for (auto v = mesh.vertices_sbegin(); v != mesh.vertices_end(); ++v) ++left;
  return left;
}

TriangleMesh collapse_once(const TriangleMesh& input, int target, const CollapseConfig& config) {
  Mesh mesh = to_openmesh(input);
  mesh.update_face_normals();
  const auto wanted = static_cast<std::size_t>(target);
  collapse(mesh, wanted, config, true);
  // Where well-shaped faces alone do not lead to the target, thin ones are accepted.
  if (vertices_left(mesh) > wanted) collapse(mesh, wanted, config, false);
  return remaining(mesh, input);
}

}  // namespace

TriangleMesh collapse_edges(const TriangleMesh& mesh, const CollapseConfig& config, bool may_not_cross,
                            CollapseReport& report) {
  report.target_vertices = config.target_vertices;
  if (mesh.num_vertices() <= config.target_vertices) {
    report.passed_through = true;
    return mesh;
  }
  for (double target = config.target_vertices; target < static_cast<double>(mesh.num_vertices());
       target *= kMoreVertices) {
    report.target_vertices = static_cast<int>(target);
    TriangleMesh result = collapse_once(mesh, report.target_vertices, config);
    const std::size_t crossings = may_not_cross ? self_intersections(result).size() : 0;
    if (crossings == 0) return result;
    log_warning("with {} vertices {} pairs of faces cross; trying with more", result.num_vertices(), crossings);
    ++report.retries;
  }
  throw DataError("the surface crosses itself with any number of vertices from {} to {}", config.target_vertices,
                  mesh.num_vertices());
}

}  // namespace tacipc
