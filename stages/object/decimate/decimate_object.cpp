#include "stages/object/decimate/decimate_object.h"

#include "common/base/log.h"
#include "stages/object/decimate/object_size.h"
#include "stages/object/decimate/surface_topology.h"

namespace tacipc {
namespace {

Value::Map repairs(const DoctorReport& report) {
  Value::Map lines{{"unreferenced_vertices", report.unreferenced_vertices},
                   {"merged_vertices", report.merged_vertices},
                   {"degenerate_faces", report.degenerate_faces},
                   {"duplicate_faces", report.duplicate_faces},
                   {"reoriented_faces", report.reoriented_faces},
                   {"separated_edges", report.separated_edges},
                   {"split_vertices", report.split_vertices},
                   {"filled_holes", report.filled_holes},
                   {"hole_faces", report.hole_faces},
                   {"debris_components", report.debris_components},
                   {"thickened_sheets", report.thickened_sheets},
                   {"flat_components", report.flat_components},
                   {"hidden_components", report.hidden_components}};
  if (const auto& taken = report.height_field) {
    lines.emplace_back("height_field", Value::Map{{"side", taken->side},
                                                  {"reason", taken->reason},
                                                  {"spacing_mm", 1e3 * taken->error.spacing_m},
                                                  {"mean_error_mm", 1e3 * taken->error.mean_m},
                                                  {"max_error_mm", 1e3 * taken->error.max_m}});
  }
  return lines;
}

std::vector<double> extents_mm(const TriangleMesh& mesh) {
  const Eigen::RowVector3d extents = mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff();
  return {1e3 * extents[0], 1e3 * extents[1], 1e3 * extents[2]};
}

/// Position on the gel of the bounding box's centre at which the best window lies in the sensor's field of view.
std::vector<double> center_mm(const SideView& view) {
  return {0.0 - 1e3 * view.place_m[0], 0.0 - 1e3 * view.place_m[1]};
}

/// Lines for a press: the side, the position on the gel (the sample file's `center_mm`), and warnings.
Value::Map sides_of(const SideSurvey& survey, const std::string& hint) {
  Value::List views;
  for (const SideView& view : survey.views) {
    views.emplace_back(Value::Map{{"side", view.side},
                                  {"relief_mm", 1e3 * view.relief_m},
                                  {"center_mm", center_mm(view)},
                                  {"extent_mm", std::vector<double>{1e3 * view.extent_m[0], 1e3 * view.extent_m[1]}}});
  }
  return {{"pressed", survey.side().side},
          {"given", survey.given},
          {"center_mm", center_mm(survey.side())},
          {"window_mm", std::vector<double>{1e3 * survey.window_m[0], 1e3 * survey.window_m[1]}},
          {"wider_than_window", survey.wider_than_window()},
          {"uniform", survey.uniform()},
          {"size_hint", hint},
          {"views", std::move(views)}};
}

/// Hint that the unit may be wrong: the object's size is far from the window's, and another unit would bring it near.
std::string size_hint(const SideSurvey& survey, double extent_m, const std::string& unit) {
  constexpr double kFar = 5.0;
  const double window_m = std::max(survey.window_m[0], survey.window_m[1]);
  const std::string fitting = units_that_fit(extent_m, unit, window_m);
  if (fitting.empty() || (extent_m < kFar * window_m && kFar * extent_m > window_m)) return "";
  return fmt::format("{:.3g} mm wide, the sensor's window {:.3g} mm: is the unit right?{}", 1e3 * extent_m,
                     1e3 * window_m, fitting);
}

void say(const SideSurvey& survey, const std::string& hint) {
  const SideView& side = survey.side();
  if (!hint.empty()) log_warning("the object is {}", hint);
  log_info("its side {} shows {:.3g} mm of relief in the sensor's window{}", side.side, 1e3 * side.relief_m,
           survey.given ? "" : ", and is pressed");
  if (survey.uniform()) {
    log_warning("the image will be uniform: the side {} is flat and fills the sensor's window of {:.3g} x {:.3g} mm",
                side.side, 1e3 * survey.window_m[0], 1e3 * survey.window_m[1]);
  } else if (survey.wider_than_window()) {
    log_warning(
        "the object is wider ({:.3g} x {:.3g} mm) than the sensor's window ({:.3g} x {:.3g} mm): the image shows a "
        "part of it",
        1e3 * side.extent_m[0], 1e3 * side.extent_m[1], 1e3 * survey.window_m[0], 1e3 * survey.window_m[1]);
  }
}

}  // namespace

DecimatedObject decimate_object(const TriangleMesh& scan, const DecimateConfig& config) {
  log_info("{} vertices, {} faces read", scan.num_vertices(), scan.num_triangles());
  DoctorReport found;
  const TriangleMesh sound = treat_mesh(scan, config.doctor, found);
  if (!found.changed_mesh()) log_info("nothing to repair");

  // A union of overlapping parts, or a scan that crosses itself, cannot be required not to cross.
  const bool may_not_cross = found.self_intersections == 0 && found.overlapping_components == 0;
  if (sound.num_vertices() > config.collapse.target_vertices)
    log_info("collapsing edges until {} vertices are left", config.collapse.target_vertices);
  CollapseReport collapsed;
  TriangleMesh mesh = collapse_edges(sound, config.collapse, may_not_cross, collapsed);
  if (collapsed.passed_through)
    log_info("{} vertices are no more than the target {}: passed through unchanged", sound.num_vertices(),
             config.collapse.target_vertices);
  else
    log_info("{} vertices, {} faces left", mesh.num_vertices(), mesh.num_triangles());
  if (!collapsed.passed_through && mesh.num_vertices() > collapsed.target_vertices)
    log_warning("{} vertices are left: no further edge can collapse without flipping a face", mesh.num_vertices());

  // Distance to the scan after the doctor: parts removed as debris or hidden do not belong to the object.
  const Hausdorff distance = collapsed.passed_through ? Hausdorff{} : hausdorff_distance(sound, mesh, config.hausdorff);
  if (!collapsed.passed_through) log_info("Hausdorff distance {:.4g} mm", 1e3 * distance.max_m());

  DecimatedObject object;
  object.summary = {{"input_vertices", static_cast<std::int64_t>(scan.num_vertices())},
                    {"input_faces", static_cast<std::int64_t>(scan.num_triangles())},
                    {"vertices", static_cast<std::int64_t>(mesh.num_vertices())},
                    {"faces", static_cast<std::int64_t>(mesh.num_triangles())},
                    {"passed_through", collapsed.passed_through},
                    {"retries", collapsed.retries},
                    {"hausdorff_mm", Value::Map{{"input_to_output", 1e3 * distance.first_to_second_m},
                                                {"output_to_input", 1e3 * distance.second_to_first_m},
                                                {"max", 1e3 * distance.max_m()}}},
                    {"extents_mm", extents_mm(mesh)},
                    {"volume_mm3", 1e9 * signed_volume(mesh)},
                    {"area_mm2", 1e6 * surface_area(mesh)},
                    {"components", found.components},
                    {"overlapping_components", found.overlapping_components},
                    {"self_intersections", found.self_intersections},
                    {"repairs", repairs(found)}};
  if (config.doctor.window) {
    const std::string wanted = found.height_field           ? found.height_field->side
                               : config.doctor.height_field ? config.doctor.height_field->side
                                                            : "";
    SideSurvey survey = survey_sides(mesh, *config.doctor.window, wanted);
    survey.given = survey.given && config.doctor.height_field->side != SideConfig::kMostRelief;
    const std::string hint = size_hint(survey, largest_extent(mesh), config.doctor.unit);
    say(survey, hint);
    object.summary.emplace_back("sides", sides_of(survey, hint));
    object.sides = picture_of_sides(survey);
  }
  object.mesh = std::move(mesh);
  return object;
}

}  // namespace tacipc
