#include "stages/gel/tetmesh/import.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/units.h"
#include "common/mesh/exact_predicates.h"
#include "common/mesh/triangle_mesh.h"
#include "stages/gel/tetmesh/mesh_check.h"
#include "stages/gel/tetmesh/outline.h"

namespace tacipc {
namespace {

/// Rotation about an axis; quarter turns about a coordinate axis are exact.
Matrix3 rotation_about(const Vector3& axis, double angle_deg) {
  Matrix3 r = Eigen::AngleAxisd(angle_deg * kDegree, axis.normalized()).toRotationMatrix();
  for (double& entry : r.reshaped()) {
    if (std::abs(entry - std::round(entry)) < 1e-15) entry = std::round(entry) + 0.0;
  }
  return r;
}

/// Makes all tetrahedra positive if all are negative. \throw DataError if they disagree or one has no volume
bool orient(TetMesh& mesh, const std::string& name) {
  Eigen::Index negative = 0, first_negative = -1;
  for (Eigen::Index t = 0; t < mesh.num_tets(); ++t) {
    const Vector3 a = mesh.positions.row(mesh.tets(t, 0)), b = mesh.positions.row(mesh.tets(t, 1)),
                  c = mesh.positions.row(mesh.tets(t, 2)), d = mesh.positions.row(mesh.tets(t, 3));
    const int sign = orient3d(a, b, c, d);
    if (sign > 0) continue;
    if (sign == 0) throw DataError("{}: tet {} has no volume", name, t);
    if (negative++ == 0) first_negative = t;
  }
  if (negative == 0) return false;
  if (negative < mesh.num_tets()) {
    throw DataError("{}: {} of {} tets are negatively oriented, the first is tet {}", name, negative, mesh.num_tets(),
                    first_negative);
  }
  mesh.tets.col(0).swap(mesh.tets.col(1));
  return true;
}

BoundaryTag tag_of(const TetMesh& mesh, Eigen::Index f, const ImportConfig& config) {
  const Vector3 a = mesh.positions.row(mesh.boundary(f, 0)), b = mesh.positions.row(mesh.boundary(f, 1)),
                c = mesh.positions.row(mesh.boundary(f, 2));
  const double up = (b - a).cross(c - a).normalized().z();
  if (config.glued_plane_z_m) {
    const auto on_plane = [&](const Vector3& x) {
      return std::abs(x.z() - *config.glued_plane_z_m) <= config.glued_tolerance_m;
    };
    if (on_plane(a) && on_plane(b) && on_plane(c)) return BoundaryTag::glued;
  } else if (-up >= std::cos(*config.glued_max_angle_deg * kDegree)) {
    return BoundaryTag::glued;
  }
  return up >= std::cos(config.front_max_angle_deg * kDegree) ? BoundaryTag::front : BoundaryTag::side;
}

double inside(const TetMesh& mesh, Eigen::Index v, const GelShape& gel) {
  return distance_inside(gel, mesh.positions.row(v).head<2>().transpose());
}

/// Checks that the mesh has the sensor's outline and depth, because loads and images would otherwise be those of
/// another gel: its outermost vertex lies on the outline, and its lowest one a thickness deep.
void check_extent(const TetMesh& mesh, const GelShape& gel, double tolerance_m, const std::string& name) {
  const Vector3 low = mesh.positions.colwise().minCoeff(), high = mesh.positions.colwise().maxCoeff();
  double outermost = gel.thickness_m + std::max(gel.radius_m, gel.width_m);
  for (Eigen::Index v = 0; v < mesh.num_vertices(); ++v) outermost = std::min(outermost, inside(mesh, v, gel));
  const double off = std::max(std::abs(low.z() + gel.thickness_m), std::abs(outermost));
  if (off <= tolerance_m) return;
  const bool disc = gel.outline == GelShape::Outline::disc;
  throw DataError(
      "{}: its outline or depth differs from the sensor's gel by {:.3g} mm, more than {:g} mm; "
      "after the transform it fills "
      "x {:.4g} … {:.4g}, y {:.4g} … {:.4g}, z {:.4g} … {:.4g} mm, the gel {:.4g} × {:.4g} mm and {:.4g} … 0 mm",
      name, off / kMillimetre, tolerance_m / kMillimetre, low.x() / kMillimetre, high.x() / kMillimetre,
      low.y() / kMillimetre, high.y() / kMillimetre, low.z() / kMillimetre, high.z() / kMillimetre,
      (disc ? 2.0 * gel.radius_m : gel.width_m) / kMillimetre, (disc ? 2.0 * gel.radius_m : gel.height_m) / kMillimetre,
      -gel.thickness_m / kMillimetre);
}

void check_side(const TetMesh& mesh, const GelShape& gel, double tolerance_m, const std::string& name) {
  for (const int v : mesh.vertices(BoundaryTag::side)) {
    const double off = std::abs(inside(mesh, v, gel));
    if (off <= tolerance_m) continue;
    throw DataError("{}: side vertex {} lies {:.3g} mm off the sensor's outline, more than {:g} mm", name, v,
                    off / kMillimetre, tolerance_m / kMillimetre);
  }
}

}  // namespace

ImportConfig ImportConfig::read(ConfigReader& in) {
  ImportConfig config;
  config.unit_m = metres_per_unit(in.choice("unit", kLengthUnits));
  ConfigReader transform = in.section("transform");
  const auto scale = transform.numbers("scale", 3, Range::positive());
  config.scale = {scale[0], scale[1], scale[2]};
  const Vector3 axis = transform.vector3("rotation_axis");
  const double angle_deg = transform.number("rotation_deg", Range::between(-360.0, 360.0));
  if (axis.norm() < 1e-9) {
    transform.fault("rotation_axis", "must not be zero");
  } else {
    config.rotation = rotation_about(axis, angle_deg);
  }
  const auto translation_mm = transform.numbers("translation_mm", 3, Range::between(-1e6, 1e6));
  config.translation_m = kMillimetre * Vector3(translation_mm[0], translation_mm[1], translation_mm[2]);
  ConfigReader glued = in.section("glued");
  if (const auto z = glued.optional_number("plane_z_mm")) {
    config.glued_plane_z_m = kMillimetre * *z;
    config.glued_tolerance_m = kMillimetre * glued.number("tolerance_mm", Range::non_negative());
  }
  config.glued_max_angle_deg = glued.optional_number("max_angle_deg", Range::between(0.0, 90.0));
  if (config.glued_plane_z_m.has_value() == config.glued_max_angle_deg.has_value()) {
    glued.fault("plane_z_mm", "give either plane_z_mm (with tolerance_mm) or max_angle_deg");
    config.glued_max_angle_deg = 0.0;
  }
  ConfigReader front = in.section("front");
  config.front_max_angle_deg = front.number("max_angle_deg", Range::between(0.0, 89.0));
  ConfigReader limits = in.section("limits");
  config.fit_tolerance_m = kMillimetre * limits.number("fit_tolerance_mm", Range::non_negative());
  config.min_dihedral_deg = limits.number("min_dihedral_deg", Range::between(0.0, 20.0));
  return config;
}

Vector3 ImportConfig::sensor_from_file(const Vector3& x) const {
  // Adding zero turns −0 into 0.
  return (rotation * (unit_m * scale.cwiseProduct(x)) + translation_m).array() + 0.0;
}

ImportedGel import_gel(const std::filesystem::path& path, const ImportConfig& config, const GelShape& gel) {
  const std::string name = path.string();
  const MshContent content = read_msh(path);
  if (content.tets.rows() == 0) throw DataError("{}: has no tets", name);
  ImportedGel imported;
  TetMesh& mesh = imported.mesh;
  mesh.positions.resize(content.positions.rows(), 3);
  for (Eigen::Index v = 0; v < content.positions.rows(); ++v) {
    mesh.positions.row(v) = config.sensor_from_file(content.positions.row(v).transpose());
  }
  mesh.tets = content.tets;
  imported.flipped = orient(mesh, name);
  if (imported.flipped) log_warning("{}: all {} tets are negatively oriented; reoriented", name, mesh.num_tets());
  check_extent(mesh, gel, config.fit_tolerance_m, name);
  mesh.boundary = boundary_triangles(mesh.tets, mesh.num_vertices());
  for (Eigen::Index f = 0; f < mesh.boundary.rows(); ++f) mesh.tags.push_back(tag_of(mesh, f, config));
  check_faces(mesh, name);
  check_side(mesh, gel, config.fit_tolerance_m, name);
  check_gel(mesh, gel, {.min_dihedral_deg = config.min_dihedral_deg, .front_tolerance_m = config.fit_tolerance_m},
            name);
  return imported;
}

}  // namespace tacipc
