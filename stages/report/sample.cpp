#include "stages/report/sample.h"

#include <algorithm>
#include <cmath>

#include "common/error.h"
#include "common/files.h"
#include "common/npy.h"
#include "stages/report/record.h"
#include "stages/report/stage_log.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// The file's name, or where every file is called object.ply its folder's.
std::string object_name(const fs::path& mesh) {
  const std::string stem = mesh.stem().string();
  return stem == "object" && mesh.has_parent_path() ? mesh.parent_path().filename().string() : stem;
}

PlacementReport read_placement(const Record& press) {
  const Record chosen = press.section("config").section("sample").section("placement");
  const auto up = press.section("config").section("object-config").text("up");
  PlacementReport placement;
  placement.face = press.section("summary").text("face").value_or("unknown");
  placement.chosen = chosen.has("face") ? "named by the sample"
                     : up               ? "opposite of the object's up side " + *up
                                        : "default";
  placement.rotate_deg = chosen.number("rotate_deg").value_or(0.0);
  const auto center = chosen.numbers("center_mm", 2).value_or(std::vector<double>{0.0, 0.0});
  placement.center_x_mm = center[0];
  placement.center_y_mm = center[1];
  return placement;
}

/// Depth per frame follows from the object's poses: its lowest point moves as its pose does, and ends at `depth_m`.
std::vector<FrameReport> read_frames(const Record& summary, const fs::path& poses_path, double depth_m) {
  const auto records = summary.sections("per_frame");
  const NpyArray poses = read_npy(poses_path);
  if (poses.shape != std::vector<std::size_t>{records.size(), 4, 4}) {
    throw DataError("{}: does not hold a 4 x 4 pose for each of the {} frames of press.yaml", poses_path.string(),
                    records.size());
  }
  constexpr std::size_t kPose = 16, kHeight = 11;
  std::vector<FrameReport> frames;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double above_last_m = poses.data[kPose * i + kHeight] - poses.data[kPose * (records.size() - 1) + kHeight];
    if (!std::isfinite(above_last_m)) throw DataError("{}: the pose of frame {} is not finite", poses_path.string(), i);
    frames.push_back({.depth_m = depth_m - above_last_m,
                      .press_force_n = records[i].required_number("press_force_n"),
                      .newton_iterations = records[i].required_count("newton_iterations"),
                      .min_gap_m = records[i].required_number("min_gap_m"),
                      .min_volume_ratio = records[i].required_number("min_volume_ratio")});
  }
  return frames;
}

DecimateReport read_decimate(const Record& record) {
  constexpr std::pair<const char*, const char*> kRepairs[] = {{"unreferenced_vertices", "unused vertices removed"},
                                                              {"merged_vertices", "vertices merged"},
                                                              {"degenerate_faces", "faces without area treated"},
                                                              {"duplicate_faces", "duplicate faces removed"},
                                                              {"reoriented_faces", "faces turned over"},
                                                              {"split_vertices", "vertices split"},
                                                              {"filled_holes", "holes filled"},
                                                              {"hole_faces", "faces added in holes"},
                                                              {"debris_components", "loose bits removed"},
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

void link_if_there(std::vector<std::pair<std::string, fs::path>>& links, const std::string& label,
                   const fs::path& path) {
  if (fs::is_regular_file(path)) links.emplace_back(label, path);
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
  const Record record = Record::from_file(record_path);
  if (const auto scan = record.section("inputs").section("mesh").text("path")) sample.object = object_name(*scan);
  sample.decimate = read_decimate(record);
}

/// Throws where the press is not one that passed.
void read_press(const fs::path& folder, SampleReport& sample) {
  const Record press = Record::from_file(folder / "press.yaml");
  const Record summary = press.section("summary");
  sample.name = press.text("name").value_or(sample.name);
  sample.press_force_n = summary.required_number("press_force_n");
  sample.min_distance_m = summary.required_number("min_distance_m");
  sample.min_volume_ratio = summary.required_number("min_volume_ratio");
  sample.newton_iterations = summary.required_count("newton_iterations");
  sample.gel_vertices = summary.required_count("gel_vertices");
  sample.placement = read_placement(press);
  read_object(folder, press, sample);
  const Record motion = press.section("config").section("sample").section("motion");
  sample.depth_m = 1e-3 * motion.required_number("depth_mm");
  sample.frames = read_frames(summary, folder / "object_pose.npy", *sample.depth_m);
  if (!summary.required_flag("converged")) throw SolverError("press: Newton did not converge");
  if (const int count = summary.required_count("intersections"); count > 0)
    throw SolverError("press: {} triangle pairs intersect", count);
  if (const int count = summary.required_count("inverted_tets"); count > 0)
    throw SolverError("press: {} tetrahedra are inverted", count);
}

void read_render(const fs::path& folder, SampleReport& sample) {
  const Record render = Record::from_file(folder / "render.yaml");
  const auto press_hash = render.section("inputs").section("press").text("hash");
  if (press_hash && *press_hash != content_hash(sample.folder / "press"))
    throw DataError("render: the images are of an older press; render again");
  sample.synthetic_reference = render.text("reference") == "synthetic";
  sample.max_indentation_m = 1e-3 * render.section("summary").required_number("max_indentation_mm");
  if (sample.frames.empty()) return;
  const fs::path last = folder / fmt::format("frame_{:04}", sample.frames.size() - 1);
  const SampleImages images{.tactile = last / "tactile.png",
                            .indentation = last / "indentation.png",
                            .normal = last / "normal.png",
                            .no_contact = folder / "frame_0000" / "tactile.png"};
  for (const fs::path& path : {images.tactile, images.indentation, images.normal, images.no_contact}) {
    if (!fs::is_regular_file(path)) throw DataError("{}: is missing", path.string());
  }
  sample.images = images;
  for (const char* name : {"linear.exr", "depth.exr", "normal.exr", "indentation.exr"})
    link_if_there(sample.data, name, last / name);
}

/// Placement and depth a failed press was asked for, where the sample brings them along.
void read_wish(const fs::path& path, SampleReport& sample) {
  if (!fs::is_regular_file(path)) return;
  if (const auto depth_mm = Record::from_file(path).section("motion").number("depth_mm"))
    sample.depth_m = 1e-3 * *depth_mm;
}

void judge(SampleReport& sample) {
  if (!fs::is_regular_file(sample.folder / "press" / "press.yaml")) {
    sample.failure = failure_reason(sample.folder / "press", "press");
    read_wish(sample.folder / "sample.yaml", sample);
    return;
  }
  read_press(sample.folder / "press", sample);
  if (!fs::is_regular_file(sample.folder / "render" / "render.yaml")) {
    sample.failure = failure_reason(sample.folder / "render", "render");
    return;
  }
  read_render(sample.folder / "render", sample);
}

fs::path without_slash(const fs::path& folder) { return folder.has_filename() ? folder : folder.parent_path(); }

/// Paths below the sample's folder are shown from there, so that the page does not depend on where it was made.
std::string without_folder(std::string text, const fs::path& folder) {
  const std::string prefix = folder.string() + "/";
  for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix, at)) {
    // Only whole paths: "./" is also the end of "../".
    if (at == 0 || text[at - 1] == ' ')
      text.erase(at, prefix.size());
    else
      at += prefix.size();
  }
  return text;
}

}  // namespace

SampleReport read_sample(const fs::path& given) {
  SampleReport sample;
  sample.folder = without_slash(given.lexically_normal());
  if (!fs::is_directory(sample.folder / "press") && !fs::is_regular_file(sample.folder / "sample.yaml")) {
    throw DataError("{}: has neither a press folder nor a sample.yaml, so it is no sample's folder",
                    sample.folder.string());
  }
  sample.name = without_slash(fs::absolute(sample.folder).lexically_normal()).filename().string();
  link_if_there(sample.records, "sample.yaml", sample.folder / "sample.yaml");
  for (const char* stage : {"press", "render"}) {
    for (const char* ending : {".yaml", ".log"})
      link_if_there(sample.records, stage + std::string(ending), sample.folder / stage / (stage + std::string(ending)));
  }
  for (const char* name : {"positions.npy", "object_pose.npy", "wrench.npy", "contact_force.npy"})
    link_if_there(sample.data, name, sample.folder / "press" / name);
  try {
    judge(sample);
  } catch (const std::runtime_error& error) {
    sample.failure = without_folder(error.what(), sample.folder);
  }
  if (sample.synthetic_reference.value_or(false)) {
    sample.warnings.push_back(
        "Synthetic reference image: the sensor file names no photograph of the real sensor without contact");
  }
  for (const char* stage : {"press", "render"}) {
    for (const std::string& warning : log_messages(sample.folder / stage / (stage + std::string(".log")), "warning"))
      sample.warnings.push_back(fmt::format("{}: {}", stage, warning));
  }
  return sample;
}

}  // namespace tacipc
