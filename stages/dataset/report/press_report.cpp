#include "stages/dataset/report/press_report.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/mesh/triangle_mesh.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"
#include "common/sample/sample_status.h"
#include "common/stage/record.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Name of an object: its file's name, or its folder's if every file is called object.ply.
std::string object_name(const fs::path& mesh) {
  const std::string stem = mesh.stem().string();
  return stem == "object" && mesh.has_parent_path() ? mesh.parent_path().filename().string() : stem;
}

PlacementReport read_placement(const Record& press) {
  const Record chosen = press.section("config").section("sample").section("placement");
  const auto up = press.section("config").section("object-config").text("up");
  PlacementReport placement;
  placement.face = summary_of<PressSummary>(press).find(&PressSummary::face).value_or("unknown");
  placement.chosen = chosen.has("face") ? "named by the sample"
                     : up               ? "opposite of the object's up side " + *up
                                        : "default";
  placement.rotate_deg = chosen.number("rotate_deg").value_or(0.0);
  const auto center = chosen.numbers("center_mm", 2).value_or(std::vector<double>{0.0, 0.0});
  placement.center_x_mm = center[0];
  placement.center_y_mm = center[1];
  return placement;
}

/// Depth of the object's lowest point below z = 0, for any pose.
double depth_at(const Matrix4& gel_from_object, const Positions& object) {
  const Vector3 up = gel_from_object.row(2).head<3>();  // gradient of the height in the object's own frame
  return 0.0 - ((object * up).minCoeff() + gel_from_object(2, 3));
}

std::vector<FrameReport> read_frames(const RecordLines<PressSummary>& summary) {
  using Lines = PressFrameLines;
  std::vector<FrameReport> frames;
  for (const RecordLines<Lines>& lines : summary.sections(&PressSummary::per_frame)) {
    frames.push_back({.depth_m = std::nullopt,
                      .press_force_n = lines.required(&Lines::press_force_n),
                      .newton_iterations = lines.required(&Lines::newton_iterations),
                      .min_gap_m = lines.find(&Lines::min_gap_m),
                      .min_volume_ratio = lines.required(&Lines::min_volume_ratio),
                      .time_s = lines.find(&Lines::time_s),
                      .phase = lines.find(&Lines::phase).value_or(""),
                      .tangential_force_n = lines.find(&Lines::tangential_force_n),
                      .torque_z_n_m = std::nullopt,
                      .balance_n = lines.find(&Lines::balance_n),
                      .balance_relative = lines.find(&Lines::balance_relative),
                      .contact_area_mm2 = lines.find(&Lines::contact_area_mm2),
                      .mean_pressure_pa = lines.find(&Lines::mean_pressure_pa),
                      .peak_pressure_pa = lines.find(&Lines::peak_pressure_pa),
                      .pose_error_m = lines.find(&Lines::pose_error_m),
                      .sticking = lines.find(&Lines::sticking),
                      .slipping = lines.find(&Lines::slipping),
                      .substeps = lines.find(&Lines::substeps)});
  }
  if (frames.empty()) throw DataError("press.yaml: summary.{}: has no frames", key_of(&PressSummary::per_frame));
  return frames;
}

void add_torques(const PressFolder& press, std::vector<FrameReport>& frames) {
  if (!press.has(PressArray::wrench)) return;
  const std::vector<Wrench> wrenches = press.wrenches();
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].torque_z_n_m = wrenches[i].torque_n_m.z();
}

/// Adds the depths of all frames, and the depth of the sample: at the end of the press, or otherwise the deepest.
void add_depths(const PressFolder& arrays, const Record& press, SampleReport& sample) {
  if (press.section("config").section("sample").has("bodies")) return;  // a scene has no single object
  const std::vector<Matrix4> poses = arrays.poses();
  std::string why;
  const auto object_path = pressed_input(arrays.folder(), press, "object", why);
  if (!object_path) {
    sample.warnings.push_back("press: " + why + ", so the depths per frame are not known");
    return;
  }
  const Positions object = read_triangle_mesh(*object_path, 1.0).positions;
  for (std::size_t i = 0; i < sample.frames.size(); ++i) sample.frames[i].depth_m = depth_at(poses[i], object);
  if (sample.press_end_frame) {
    sample.depth_m = sample.frames[static_cast<std::size_t>(*sample.press_end_frame)].depth_m;
  } else {
    sample.depth_m.reset();
    for (const FrameReport& frame : sample.frames) sample.depth_m = std::max(sample.depth_m, frame.depth_m);
  }
}

DecimateReport read_decimate(const Record& record) {
  constexpr std::pair<const char*, const char*> kRepairs[] = {
      {"unreferenced_vertices", "unused vertices removed"},
      {"merged_vertices", "vertices merged"},
      {"degenerate_faces", "faces without area treated"},
      {"duplicate_faces", "duplicate faces removed"},
      {"reoriented_faces", "faces turned over"},
      {"separated_edges", "edges of more than two faces taken apart"},
      {"split_vertices", "vertices split"},
      {"filled_holes", "holes filled"},
      {"hole_faces", "faces added in holes"},
      {"debris_components", "loose bits removed"},
      {"thickened_sheets", "open parts made plates"},
      {"flat_components", "parts without volume removed"},
      {"hidden_components", "hidden parts removed"}};
  constexpr std::pair<const char*, const char*> kLeft[] = {{"overlapping_components", "parts that overlap"},
                                                           {"self_intersections", "crossing faces in the scan"}};
  const Record summary = record.section("summary");
  DecimateReport report;
  report.vertices_in = summary.count("input_vertices");
  report.vertices_out = summary.count("vertices");
  report.hausdorff_mm = summary.section("hausdorff_mm").number("max");
  report.passed_through = summary.flag("passed_through").value_or(false);
  const auto add = [&](const Record& record_part, const auto& keys) {
    for (const auto& [key, words] : keys) {
      if (const int count = record_part.count(key).value_or(0); count > 0) report.findings.emplace_back(words, count);
    }
  };
  add(summary.section("repairs"), kRepairs);
  add(summary, kLeft);
  return report;
}

void warn_of_scale(const Record& summary, SampleReport& sample) {
  if (const double scale = summary.number("scale").value_or(1.0); scale != 1.0)
    sample.warnings.push_back(fmt::format("The object is scaled by {:.4g}.", scale));
}

/// Reads the survey of sides. An object gripped by fingers has no pressing side, so its pictures and warnings would
/// mislead.
void read_sides(const fs::path& folder, const Record& sides, SampleReport& sample) {
  const bool one_presses = sample.placement.has_value();
  if (const fs::path picture = folder / "sides.png"; one_presses && fs::is_regular_file(picture))
    sample.sides = picture;
  const auto window = sides.numbers("window_mm", 2);
  if (!window) return;
  const std::string size = fmt::format("{:.3g} × {:.3g} mm", (*window)[0], (*window)[1]);
  if (const std::string hint = sides.text("size_hint").value_or(""); !hint.empty())
    sample.warnings.push_back("The object is " + hint + ".");
  if (!one_presses) return;
  if (sides.flag("uniform").value_or(false)) {
    sample.warnings.push_back(
        fmt::format("The image is uniform: the side that presses is flat and fills the sensor's window of {}.", size));
  } else if (sides.flag("wider_than_window").value_or(false)) {
    sample.warnings.push_back(
        fmt::format("The object is wider than the sensor's window of {}: the image shows a part of it.", size));
  }
}

/// Reads the record of the stage wrap, if decimate read its result. `scale` is decimate's factor on the size.
void read_wrap(const fs::path& folder, double scale, SampleReport& sample) {
  const fs::path path = (folder / "wrap.yaml").lexically_normal();
  if (!fs::is_regular_file(path)) return;
  link_if_there(sample.records, "wrap.yaml", path);
  const Record record = Record::from_file(path);
  if (const auto scan = record.section("inputs").section("mesh").text("path")) sample.object = object_name(*scan);
  const Record summary = record.section("summary"), error = summary.section("seen_mesh_to_wrap_mm");
  warn_of_scale(summary, sample);
  sample.warnings.push_back(fmt::format(
      "The object's mesh was replaced by a closed surface wrapped around it, which fills gaps and grooves that a ball "
      "of {:.3g} mm does not get into. What is seen of the mesh lies {:.4g} µm below that surface in the mean, {:.4g} "
      "µm at most.",
      scale * summary.required_number("alpha_mm"), 1e3 * scale * error.required_number("mean"),
      1e3 * scale * error.required_number("max")));
}

void read_object(const fs::path& press_folder, const Record& press, SampleReport& sample) {
  const auto gel = press.section("inputs").section("gel").text("path");
  if (gel) link_if_there(sample.records, "tetmesh.yaml", (press_folder / *gel).parent_path() / "tetmesh.yaml");
  const auto object = press.section("inputs").section("object").text("path");
  if (!object) return;
  sample.object = object_name(*object);
  const fs::path record_path = ((press_folder / *object).parent_path() / "decimate.yaml").lexically_normal();
  if (!fs::is_regular_file(record_path)) return;
  link_if_there(sample.records, "decimate.yaml", record_path);
  const Record record = Record::from_file(record_path), summary = record.section("summary");
  if (const auto scan = record.section("inputs").section("mesh").text("path")) {
    sample.object = object_name(*scan);
    read_wrap((record_path.parent_path() / *scan).parent_path(), summary.number("scale").value_or(1.0), sample);
  }
  sample.decimate = read_decimate(record);
  warn_of_scale(summary, sample);
  read_sides(record_path.parent_path(), summary.section("sides"), sample);
  const Record repairs = summary.section("repairs");
  if (!repairs.has("height_field")) return;
  const Record taken = repairs.section("height_field");
  sample.warnings.push_back(fmt::format(
      "The object's surface cannot be closed ({}). Pressed is what its side {} shows: {:.2g} µm beside it in the mean, "
      "{:.2g} µm at most. What lies behind, seen from there, is not pressed.",
      taken.required_text("reason"), taken.required_text("side"), 1e3 * taken.required_number("mean_error_mm"),
      1e3 * taken.required_number("max_error_mm")));
}

void read_summary(const RecordLines<PressSummary>& summary, SampleReport& sample) {
  using Lines = PressSummary;
  sample.press_force_n = summary.required(&Lines::press_force_n);
  sample.tangential_force_n = summary.find(&Lines::tangential_force_n);
  sample.contact_frames = summary.find(&Lines::contact_frames);
  if (sample.contact_frames == 0) sample.warnings.emplace_back("Nothing touched the gel in any frame.");
  sample.min_distance_m = summary.find(&Lines::min_distance_m);
  sample.min_volume_ratio = summary.required(&Lines::min_volume_ratio);
  sample.newton_iterations = summary.required(&Lines::newton_iterations);
  sample.gel_vertices = summary.required(&Lines::gel_vertices);
  sample.friction_coefficient = summary.find(&Lines::friction_coefficient);
  sample.first_slip_time_s = summary.find(&Lines::first_slip_time_s);
  sample.gross_slip_time_s = summary.find(&Lines::gross_slip_time_s);
  sample.element = summary.find(&Lines::element).value_or("");
  sample.frames = read_frames(summary);
  sample.press_end_frame = summary.find(&Lines::press_end_frame);
  sample.balance_limit = summary.section(&Lines::limits).find(&PressLimits::balance_relative);
}

/// Adds data from the arrays; nothing if they were dropped after packing.
void add_arrays(const fs::path& folder, const Record& press, SampleReport& sample) {
  if (was_dropped(folder)) {
    sample.warnings.emplace_back(
        "press: its arrays were dropped after packing, so depths per frame, torques and markers are not shown");
    return;
  }
  const PressFolder arrays(folder, {{kFrames, sample.frames.size()}});
  add_depths(arrays, press, sample);
  add_torques(arrays, sample.frames);
  sample.marker_pictures = read_marker_pictures(folder, static_cast<int>(sample.frames.size()), sample.press_end_frame,
                                                pictured_frames(sample));
}

}  // namespace

void link_if_there(std::vector<std::pair<std::string, fs::path>>& links, const std::string& label,
                   const fs::path& path) {
  if (fs::is_regular_file(path)) links.emplace_back(label, path);
}

std::optional<fs::path> pressed_input(const fs::path& folder, const Record& press, const std::string& input,
                                      std::string& why) {
  const Record recorded = press.section("inputs").section(input);
  const fs::path path = (folder / recorded.text("path").value_or("")).lexically_normal();
  if (!recorded.has("path") || !fs::is_regular_file(path))
    why = "the " + input + "'s mesh is not there";
  else if (recorded.text("hash") != content_hash(path))
    why = "the " + input + "'s mesh has changed since the press";
  else
    return path;
  return std::nullopt;
}

std::vector<int> pictured_frames(const SampleReport& sample) {
  constexpr int kMaxPictures = 4;
  return chosen_frames(sample.phases, static_cast<int>(sample.frames.size()), kMaxPictures);
}

void read_press_record(const Record& press, SampleReport& sample) {
  const auto summary = summary_of<PressSummary>(press);
  sample.name = press.text("name").value_or(sample.name);
  read_summary(summary, sample);
  const Record asked = press.section("config").section("sample");
  if (!asked.has("fingers") && !asked.has("bodies")) sample.placement = read_placement(press);
  sample.motion = motion_text(asked);
  if (const auto depth_mm = asked_depth_mm(asked)) sample.depth_m = 1e-3 * *depth_mm;
  std::vector<std::string> names;
  for (const FrameReport& frame : sample.frames) names.push_back(frame.phase);
  sample.phases = phases_of(names, asked);
  sample.checks = checks_of(summary, sample.frames);
}

void judge_press(const Record& press, const SampleReport& sample) {
  const auto summary = summary_of<PressSummary>(press);
  if (!summary.required(&PressSummary::converged)) throw SolverError("press: Newton did not converge");
  const CountLimits limits = count_limits(summary);
  if (const int count = summary.required(&PressSummary::intersections); count > limits.intersections)
    throw SolverError("press: {} triangle pairs intersect", count);
  if (const int count = summary.required(&PressSummary::inverted_tets); count > limits.inverted_tets)
    throw SolverError("press: {} tetrahedra are inverted", count);
  for (const CheckReport& check : sample.checks) {
    if (check.held) continue;
    const std::string where = check.frame ? fmt::format(" in frame {}", *check.frame) : "";
    throw SolverError("press: {} is {}{}, the limit is {}", check.name, check.value, where, check.limit);
  }
  if (const auto verdict = summary.find(&PressSummary::verdict); verdict.value_or(kPassed) != kPassed)
    throw SolverError("press: its verdict is {}", *verdict);
}

void read_press(const fs::path& folder, SampleReport& sample) {
  const Record press = Record::from_file(folder / "press.yaml");
  read_press_record(press, sample);
  if (sample.press_end_frame.value_or(0) >= static_cast<int>(sample.frames.size())) {
    throw DataError("{}: summary.{}: {} is not one of the {} frames", (folder / "press.yaml").string(),
                    key_of(&PressSummary::press_end_frame), *sample.press_end_frame, sample.frames.size());
  }
  read_object(folder, press, sample);
  add_arrays(folder, press, sample);
  judge_press(press, sample);
}

}  // namespace tacipc
