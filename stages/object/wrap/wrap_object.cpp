#include "stages/object/wrap/wrap_object.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/mesh/surface_distance.h"
#include "common/sample/placement.h"
#include "stages/object/wrap/alpha_wrap.h"

namespace tacipc {
namespace {

constexpr double kOffsetPerAlpha = 1.0 / 15.0;
constexpr double kLeastOffsetPerAlpha = 1e-3;  // a smaller offset gives finer faces
constexpr double kProbes = 200.0;              // probes of the visible surface, along the diagonal

double diagonal_of(const TriangleMesh& mesh) {
  return (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
}

double alpha_for(double diagonal_m, const WrapConfig& config) {
  if (!config.alpha_m) return config.relative_alpha * diagonal_m;
  const double alpha_m = *config.alpha_m;
  if (alpha_m < WrapConfig::kFinest * diagonal_m || alpha_m > WrapConfig::kCoarsest * diagonal_m)
    throw DataError(
        "wrap.alpha_mm: {:.4g} mm for a mesh of {:.4g} mm from corner to corner, expected {:.4g} mm to {:.4g} mm",
        1e3 * alpha_m, 1e3 * diagonal_m, 1e3 * WrapConfig::kFinest * diagonal_m,
        1e3 * WrapConfig::kCoarsest * diagonal_m);
  return alpha_m;
}

double offset_for(double alpha_m, double diagonal_m, const WrapConfig& config) {
  const double offset_m = config.offset_m.value_or(kOffsetPerAlpha * alpha_m);
  const double least = kLeastOffsetPerAlpha * alpha_m, most = WrapConfig::kCoarsest * diagonal_m;
  if (offset_m < least || offset_m > most)
    throw DataError(
        "wrap.offset_mm: {:.4g} mm for a ball of {:.4g} mm and a mesh of {:.4g} mm from corner to corner, expected "
        "{:.4g} mm to {:.4g} mm",
        1e3 * offset_m, 1e3 * alpha_m, 1e3 * diagonal_m, 1e3 * least, 1e3 * most);
  return offset_m;
}

std::vector<Vector3> vertices_and_centres(const TriangleMesh& mesh) {
  std::vector<Vector3> points;
  points.reserve(mesh.num_vertices() + mesh.num_triangles());
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) points.emplace_back(mesh.positions.row(v));
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f)
    points.emplace_back((mesh.positions.row(mesh.triangles(f, 0)) + mesh.positions.row(mesh.triangles(f, 1)) +
                         mesh.positions.row(mesh.triangles(f, 2))) /
                        3.0);
  return points;
}

TriangleMesh in_view(const TriangleMesh& mesh, const Matrix3& view) {
  return {.positions = mesh.positions * view.transpose(), .triangles = mesh.triangles};
}

TriangleMesh faces_that_look_up(const TriangleMesh& mesh) {
  TriangleMesh up{.positions = mesh.positions, .triangles = Triangles(mesh.num_triangles(), 3)};
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < mesh.num_triangles(); ++f) {
    const Vector3 a = mesh.positions.row(mesh.triangles(f, 0)), b = mesh.positions.row(mesh.triangles(f, 1)),
                  c = mesh.positions.row(mesh.triangles(f, 2));
    if ((b - a).cross(c - a).z() > 0.0) up.triangles.row(count++) = mesh.triangles.row(f);
  }
  up.triangles.conservativeResize(count, 3);
  return up;
}

/// Distance of the mesh visible from the six sides to the faces of the wrap that look the same way. The back of a thin
/// wall may be nearer, but it does not press.
SurfaceDistance from_seen_mesh(const TriangleMesh& mesh, const TriangleMesh& wrap, double spacing_m) {
  SurfaceDistance all;
  double points = 0.0;
  for (const std::string& side : face_names()) {
    const Matrix3 view = view_of_side(side);
    const std::vector<Vector3> seen = seen_points(in_view(mesh, view), spacing_m);
    const SurfaceDistance distance = distance_from(faces_that_look_up(in_view(wrap, view)), seen);
    all.max_m = std::max(all.max_m, distance.max_m);
    all.mean_m += distance.mean_m * static_cast<double>(seen.size());
    points += static_cast<double>(seen.size());
  }
  all.mean_m /= std::max(points, 1.0);
  return all;
}

Value::Map lines_of(const SurfaceDistance& distance) {
  return {{"mean", 1e3 * distance.mean_m}, {"max", 1e3 * distance.max_m}};
}

}  // namespace

WrappedObject wrap_object(const TriangleMesh& read, const WrapConfig& config) {
  if (read.num_triangles() == 0) throw DataError("the mesh has no faces");
  TriangleMesh mesh = read;
  remove_unreferenced_vertices(mesh);  // even distant ones, which are not part of the surface
  const double diagonal_m = diagonal_of(mesh);
  const double alpha_m = alpha_for(diagonal_m, config);
  const double offset_m = offset_for(alpha_m, diagonal_m, config);
  log_info("{} vertices, {} faces read; wrapping with alpha {:.3g} mm, offset {:.3g} mm", read.num_vertices(),
           mesh.num_triangles(), 1e3 * alpha_m, 1e3 * offset_m);
  WrappedObject object{.mesh = alpha_wrap(mesh, alpha_m, offset_m), .summary = {}};
  const TriangleMesh& wrap = object.mesh;
  const SurfaceDistance to_mesh = distance_from(mesh, vertices_and_centres(wrap));
  const SurfaceDistance to_wrap = from_seen_mesh(mesh, wrap, diagonal_m / kProbes);
  log_warning(
      "the mesh is replaced by a surface wrapped around it, {} vertices, {:.2g} mm from it in the mean and {:.2g} mm "
      "at most; what is seen of the mesh lies {:.2g} mm below it in the mean, {:.2g} mm at most",
      wrap.num_vertices(), 1e3 * to_mesh.mean_m, 1e3 * to_mesh.max_m, 1e3 * to_wrap.mean_m, 1e3 * to_wrap.max_m);
  object.summary = {{"input_vertices", std::int64_t{read.num_vertices()}},
                    {"input_faces", std::int64_t{mesh.num_triangles()}},
                    {"vertices", std::int64_t{wrap.num_vertices()}},
                    {"faces", std::int64_t{wrap.num_triangles()}},
                    {"diagonal_mm", 1e3 * diagonal_m},
                    {"alpha_mm", 1e3 * alpha_m},
                    {"offset_mm", 1e3 * offset_m},
                    {"wrap_to_mesh_mm", lines_of(to_mesh)},
                    {"seen_mesh_to_wrap_mm", lines_of(to_wrap)},
                    {"volume_mm3", 1e9 * signed_volume(wrap)}};
  return object;
}

ObjectSpec spec_of_wrapped(ObjectSpec spec) {
  spec.unit = "m";
  spec.scale = 1.0;
  spec.wrap.reset();
  return spec;
}

}  // namespace tacipc
