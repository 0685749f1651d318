#include "stages/object/decimate/mesh_doctor.h"

#include <utility>

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/object/decimate/doctor_steps.h"
#include "stages/object/decimate/object_size.h"

namespace tacipc {
namespace {

/// Usual extent of pressed objects, m.
constexpr double kUsualExtent = 0.02;

void check_extent(const TriangleMesh& mesh, const DoctorConfig& config) {
  const double extent = largest_extent(mesh);
  if (extent < config.min_extent_m || extent > config.max_extent_m)
    throw DataError("the mesh is {:.4g} mm wide, expected {:.4g} mm to {:.4g} mm; is the unit right?{}", 1e3 * extent,
                    1e3 * config.min_extent_m, 1e3 * config.max_extent_m,
                    units_that_fit(extent, config.unit, kUsualExtent));
}

void say(std::int64_t count, const char* what) {
  if (count > 0) log_info("{} {}", count, what);
}

void log_repairs(const DoctorReport& report) {
  say(report.unreferenced_vertices, "vertices without a face removed");
  say(report.merged_vertices, "vertices at the place of another merged into it");
  say(report.degenerate_faces, "faces without area removed");
  say(report.duplicate_faces, "duplicate faces removed");
  say(report.debris_components, "small loose parts removed");
  say(report.reoriented_faces, "faces turned to look outwards");
  say(report.separated_edges, "edges of more than two faces taken apart");
  say(report.split_vertices, "vertices added where sheets met in one point");
  say(report.hole_faces, "faces added to fill holes");
  say(report.thickened_sheets, "open parts made plates of the configured thickness");
  say(report.flat_components, "closed parts without volume removed");
  say(report.hidden_components, "parts inside another removed (nothing can touch them)");
  if (report.overlapping_components > 0)
    log_warning("{} pairs of closed parts overlap: the object is taken as their union", report.overlapping_components);
}

TriangleMesh close_surface(TriangleMesh mesh, const DoctorConfig& config, DoctorReport& report) {
  const double extent = largest_extent(mesh);
  weld_open_vertices(mesh, config.relative_weld_distance * extent, report);
  remove_degenerate_faces(mesh, report);
  remove_duplicate_faces(mesh, report);
  if (mesh.num_triangles() == 0) throw DataError("the mesh has no face with an area");
  separate_sheets(mesh, report);
  remove_debris(mesh, config.debris_area_fraction, report);
  orient_consistently(mesh, report);
  split_vertices(mesh, report);
  fill_holes(mesh,
             {.max_edges = config.max_hole_edges,
              .max_length_m = config.relative_max_hole_length * extent,
              .leave_larger = config.sheet_thickness_m.has_value()},
             report);
  if (config.sheet_thickness_m) thicken_open_parts(mesh, *config.sheet_thickness_m, report);
  remove_degenerate_faces(mesh, report);  // closes a crack of zero width by faces of zero area
  remove_flat_parts(mesh, report);
  return mesh;
}

/// Closed surface, or that of one side.
TriangleMesh close_or_take_side(TriangleMesh mesh, const DoctorConfig& config, DoctorReport& report) {
  if (!config.height_field) return close_surface(std::move(mesh), config, report);
  try {
    return close_surface(mesh, config, report);
  } catch (const DataError& fault) {
    report = {};
    if (mesh.num_triangles() == 0) throw;
    SideTaken taken{.side = config.height_field->side, .reason = fault.what(), .error = {}};
    if (taken.side == SideConfig::kMostRelief) taken.side = survey_sides(mesh, config.window.value(), "").side().side;
    TriangleMesh solid = solid_of_side(mesh, taken.side, config.height_field->spacing_m, taken.error);
    log_warning(
        "the surface cannot be closed ({}): pressed is what its side {} shows, on a grid of {:.3g} mm, {:.2g} mm "
        "beside it in the mean and {:.2g} mm at most",
        taken.reason, taken.side, 1e3 * taken.error.spacing_m, 1e3 * taken.error.mean_m, 1e3 * taken.error.max_m);
    solid = close_surface(std::move(solid), config, report);
    report.height_field = std::move(taken);
    return solid;
  }
}

}  // namespace

bool DoctorReport::changed_mesh() const {
  return height_field || unreferenced_vertices + merged_vertices + degenerate_faces + duplicate_faces +
                                 reoriented_faces + separated_edges + split_vertices + hole_faces + debris_components +
                                 flat_components + hidden_components + thickened_sheets >
                             0;
}

TriangleMesh treat_mesh(TriangleMesh mesh, const DoctorConfig& config, DoctorReport& report) {
  check_extent(mesh, config);
  mesh = close_or_take_side(std::move(mesh), config, report);
  examine_components(mesh, report);
  const Eigen::Index vertices = mesh.num_vertices();
  remove_unreferenced_vertices(mesh);
  report.unreferenced_vertices += vertices - mesh.num_vertices() - report.merged_vertices;
  // The remaining parts decide the scale: a distant speck may have hidden a wrong unit.
  check_extent(mesh, config);
  log_repairs(report);
  if (report.self_intersections > 0) {
    if (config.refuse_self_intersections)
      throw DataError("the surface crosses itself: {} pairs of faces of one part intersect", report.self_intersections);
    log_warning(
        "the surface crosses itself: {} pairs of faces of one part intersect (kept: a rigid object never touches "
        "itself, and the gel stays outside all of it)",
        report.self_intersections);
  }
  return mesh;
}

}  // namespace tacipc
