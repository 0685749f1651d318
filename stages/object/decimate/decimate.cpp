#include "stages/object/decimate/decimate.h"

#include "stages/object/decimate/collapse_mesh.h"

// Included after the mesh, whose traits these use without including them.
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModAspectRatioT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>

#include <algorithm>
#include <vector>

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/object/decimate/self_intersection.h"
#include "stages/object/decimate/surface_topology.h"

namespace tacipc {
namespace {

using Mesh = CollapseMesh;

/// Quadric errors are stored as floats, and metres to the fourth power would underflow.
constexpr double kUnitsPerMetre = 1e3;
constexpr double kMoreVertices = 1.5;
/// Passes over all vertices stop at this multiple of the target; a queue in order of cost does the rest.
constexpr std::size_t kQueueFrom = 8;
/// Passes accept collapses that cost less than a distance: first this fraction of the mesh's extent, then `kFarther`
/// times more, and so on.
constexpr double kFirstDistance = 1e-5, kFarther = 2.0;
/// A pass that removes less than this fraction of the vertices has exhausted its distance.
constexpr double kFruitless = 0.05;
/// Faces whose normals differ by more than 60 degrees meet in a crease.
constexpr double kCreaseCosine = 0.5;

/// Forbids a tetrahedron to collapse into two faces back to back, which the library's link condition allows.
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
/// have equal weight regardless of face area, so that a step of narrow faces counts by its height.
template <typename MeshT>
class ModPlaneDistance : public OpenMesh::Decimater::ModBaseT<MeshT> {
 public:
  DECIMATING_MODULE(ModPlaneDistance, MeshT, PlaneDistance);
  explicit ModPlaneDistance(MeshT& mesh) : Base(mesh, false) {}
  float collapse_priority(const CollapseInfo& info) override {
    return static_cast<float>(cost(Base::mesh(), info.v0, info.v1));
  }
  void postprocess_collapse(const CollapseInfo& info) override {
    auto& quadrics = Base::mesh().quadrics;
    quadrics[info.v1.idx()] += quadrics[info.v0.idx()];
  }
  /// Cost of moving the first vertex to the second, mm².
  static double cost(const MeshT& mesh, OpenMesh::VertexHandle from, OpenMesh::VertexHandle to) {
    auto both = mesh.quadrics[from.idx()];
    both += mesh.quadrics[to.idx()];
    return std::max(0.0, both(mesh.point(to)));
  }
};

/// Adds, along a sharp edge, planes through the edge perpendicular to both faces. Without them the rim of a thin sheet,
/// whose faces all lie in one plane, could move at no cost.
void add_crease(Mesh& mesh, OpenMesh::HalfedgeHandle h) {
  const OpenMesh::Vec3d first = mesh.normal(mesh.face_handle(h));
  const OpenMesh::Vec3d second = mesh.normal(mesh.opposite_face_handle(h));
  if ((first | second) > kCreaseCosine) return;
  const OpenMesh::Vec3d edge = mesh.calc_edge_vector(h);
  for (const OpenMesh::Vec3d& normal : {first, second}) {
    OpenMesh::Vec3d across = edge % normal;
    if (across.norm() == 0.0) continue;
    const Mesh::Quadric plane(across / across.norm(), mesh.point(mesh.from_vertex_handle(h)));
    mesh.quadrics[mesh.from_vertex_handle(h).idx()] += plane;
    mesh.quadrics[mesh.to_vertex_handle(h).idx()] += plane;
  }
}

void find_quadrics(Mesh& mesh) {
  mesh.quadrics.assign(mesh.n_vertices(), Mesh::Quadric());
  for (auto face = mesh.faces_sbegin(); face != mesh.faces_end(); ++face) {
    const Mesh::Quadric plane(mesh.normal(*face), mesh.point(*mesh.cfv_iter(*face)));
    for (auto v = mesh.cfv_iter(*face); v.is_valid(); ++v) mesh.quadrics[v->idx()] += plane;
  }
  for (auto edge = mesh.edges_sbegin(); edge != mesh.edges_end(); ++edge)
    add_crease(mesh, mesh.halfedge_handle(*edge, 0));
}

/// Collapses edges in passes. Each pass takes, vertex by vertex, the cheapest permitted edge if it costs less than the
/// pass allows and nothing near it has collapsed in the same pass. This takes a tenth of the time of a queue, which
/// reevaluates every neighbour after every collapse.
class CollapsePasses : public OpenMesh::Decimater::BaseDecimaterT<Mesh> {
 public:
  explicit CollapsePasses(Mesh& mesh) : BaseDecimaterT(mesh), mesh_(mesh), near_(mesh.n_vertices(), 0) {}

  /// Stops at the target, or at a distance as large as the mesh.
  /// \return number of vertices left
  std::size_t collapse_to(std::size_t target, double extent) {
    std::size_t left = mesh_.n_vertices();
    for (double distance = kFirstDistance * extent; left > target && distance < extent; distance *= kFarther) {
      std::size_t taken = 0;
      do {
        taken = pass(left - target, distance * distance);
        left -= taken;
      } while (left > target && static_cast<double>(taken) > kFruitless * static_cast<double>(left));
    }
    return left;
  }

 private:
  struct Choice {
    double cost;
    OpenMesh::HalfedgeHandle edge;
  };

  std::size_t pass(std::size_t most, double dearest) {
    std::size_t taken = 0;
    ++pass_;
    for (const auto v : mesh_.vertices()) {
      if (taken == most) break;
      if (!mesh_.status(v).deleted() && near_[v.idx()] != pass_ && collapse_at(v, dearest)) ++taken;
    }
    return taken;
  }

  bool collapse_at(OpenMesh::VertexHandle v, double dearest) {
    choices_.clear();
    for (auto h = mesh_.cvoh_iter(v); h.is_valid(); ++h) {
      const double cost = ModPlaneDistance<Mesh>::cost(mesh_, v, mesh_.to_vertex_handle(*h));
      if (cost <= dearest) choices_.push_back({cost, *h});
    }
    std::ranges::sort(choices_, [](const Choice& a, const Choice& b) {
      return a.cost != b.cost ? a.cost < b.cost : a.edge.idx() < b.edge.idx();
    });
    for (const Choice& choice : choices_) {
      OpenMesh::Decimater::CollapseInfoT<Mesh> info(mesh_, choice.edge);
      if (!is_collapse_legal(info) || collapse_priority(info) < 0.0F) continue;
      preprocess_collapse(info);
      mesh_.collapse(choice.edge);
      for (auto face = mesh_.vf_iter(info.v1); face.is_valid(); ++face) mesh_.update_normal(*face);
      postprocess_collapse(info);
      near_[info.v1.idx()] = pass_;
      for (auto other = mesh_.cvv_iter(info.v1); other.is_valid(); ++other) near_[other->idx()] = pass_;
      return true;
    }
    return false;
  }

  Mesh& mesh_;
  std::vector<int> near_;  // per vertex, the last pass with a collapse next to it
  int pass_ = 0;
  std::vector<Choice> choices_;
};

Mesh to_openmesh(const TriangleMesh& mesh) {
  Mesh out;
  std::vector<OpenMesh::Vec3d> points;
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) {
    const Eigen::RowVector3d x = kUnitsPerMetre * mesh.positions.row(v);
    points.push_back({x[0], x[1], x[2]});
  }
  out.build(points, mesh.triangles);
  return out;
}

/// Remaining mesh, with the coordinates of the input bit by bit.
TriangleMesh remaining(const Mesh& collapsed, const TriangleMesh& input) {
  std::vector<int> corners;
  for (int f = 0; f < static_cast<int>(input.num_triangles()); ++f) {
    const auto face = collapsed.face_handle(static_cast<unsigned>(f));
    if (collapsed.status(face).deleted()) continue;
    for (auto corner = collapsed.cfv_iter(face); corner.is_valid(); ++corner) corners.push_back(corner->idx());
  }
  TriangleMesh out{input.positions, Eigen::Map<const Triangles>(corners.data(), std::ssize(corners) / 3, 3)};
  remove_unreferenced_vertices(out);
  return out;
}

/// Adds the rules of a collapse.
void add_rules(OpenMesh::Decimater::BaseDecimaterT<Mesh>& decimater, const CollapseConfig& config, bool watch_shape) {
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
}

std::size_t vertices_left(const Mesh& mesh) {
  std::size_t left = 0;
  for (auto v = mesh.vertices_sbegin(); v != mesh.vertices_end(); ++v) ++left;
  return left;
}

/// Collapses the cheapest edge of all first.
void collapse_by_queue(Mesh& mesh, std::size_t target, const CollapseConfig& config, bool watch_shape) {
  const std::size_t left = vertices_left(mesh);
  if (left <= target) return;
  OpenMesh::Decimater::DecimaterT<Mesh> decimater(mesh);
  add_rules(decimater, config, watch_shape);
  decimater.decimate(left - target);
}

TriangleMesh collapse_once(const TriangleMesh& input, int target, const CollapseConfig& config) {
  Mesh mesh = to_openmesh(input);
  mesh.update_face_normals();
  find_quadrics(mesh);
  const auto wanted = static_cast<std::size_t>(target);
  if (mesh.n_vertices() > kQueueFrom * wanted) {
    CollapsePasses passes(mesh);
    add_rules(passes, config, true);
    passes.collapse_to(kQueueFrom * wanted, kUnitsPerMetre * largest_extent(input));
  }
  collapse_by_queue(mesh, wanted, config, true);
  // If well-shaped faces alone do not reach the target, thin ones are accepted.
  collapse_by_queue(mesh, wanted, config, false);
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
