#include "stages/dataset/survey/cost_estimate.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "common/base/error.h"
#include "common/sample/dataset_plan.h"
#include "common/sample/ensemble.h"
#include "common/sample/sample_spec.h"
#include "common/sample/sample_status.h"
#include "common/sensor/averaged_volume.h"
#include "common/stage/record.h"
#include "common/stage/stage_timings.h"
#include "stages/dataset/survey/plan_lock.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Number of made samples whose bytes are counted.
constexpr std::size_t kMeasuredFolders = 200;

/// Samples of one gel and one motion.
struct Group {
  std::size_t planned = 0;
  std::size_t timed = 0, weighed = 0;                   // made samples with known seconds, and with known bytes
  double seconds = 0.0, bytes = 0.0;                    // sums over these samples
  double modelled_seconds = 0.0, modelled_bytes = 0.0;  // values of one sample
};

GelSize size_of(const Record& tetmesh) {
  const Record summary = tetmesh.section("summary"), sensor = tetmesh.section("config").section("sensor"),
               camera = sensor.section("camera");
  return {.vertices = summary.required_number("vertices"),
          .front_vertices = summary.section("front").required_number("vertices"),
          .pixels = camera.required_number("width_px") * camera.required_number("height_px"),
          .poissons_ratio = sensor.section("material").required_number("poissons_ratio")};
}

MotionLength length_of(const fs::path& sample_folder) {
  const fs::path file = (is_finger(sample_folder) ? sample_folder.parent_path() : sample_folder) / "sample.yaml";
  MotionLength length;
  if (is_finger(sample_folder)) {
    ConfigReader grasp = ConfigReader::from_file(file);
    for (ConfigReader& phase : grasp.sections("motion")) {
      length.other_frames += phase.integer("steps", 1);
      length.kinds.push_back(phase.text("kind"));
    }
    return length;
  }
  const auto sample = read_config<SampleSpec>(file);
  for (const Phase& phase : sample.motion) {
    (phase.kind == PhaseKind::press ? length.press_frames : length.other_frames) += phase.steps;
    length.kinds.emplace_back(name_of(phase.kind));
  }
  return length;
}

RenderedFrames frames_of_render(const fs::path& dataset) {
  const Record plan = Record::from_file(dataset / "plan/plan.yaml");
  const fs::path path = plan.section("inputs").section("render").required_text("path");
  return read_rendered_frames(dataset / "plan" / path);
}

/// \param presses presses of an ensemble for the sample
std::optional<double> processor_seconds(const fs::path& sample, const std::vector<std::string>& presses) {
  std::optional<double> seconds;
  for (const char* stage : {"press", "render"})
    if (const auto file = timings_file(sample, stage))
      seconds = seconds.value_or(0.0) + read_timings(*file).processor_s;
  for (const std::string& press : presses)
    if (const fs::path file = member_press(sample, press) / "press.timings.yaml"; seconds && fs::exists(file))
      *seconds += read_timings(file).processor_s;
  return seconds;
}

double allocated_bytes(const fs::path& path) {
  struct stat found {};
  return ::lstat(path.c_str(), &found) == 0 ? 512.0 * static_cast<double>(found.st_blocks) : 0.0;
}

/// Bytes of a folder on disk.
double disk_bytes(const fs::path& folder) {
  double bytes = allocated_bytes(folder);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    bytes += allocated_bytes(entry.path());
  return bytes;
}

/// True if the i-th of `count` samples is among kMeasuredFolders evenly spread ones.
bool is_weighed(std::size_t i, std::size_t count) {
  return count <= kMeasuredFolders || (i + 1) * kMeasuredFolders / count != i * kMeasuredFolders / count;
}

}  // namespace

CostModel CostModel::read(ConfigReader& in) {
  return {.press_frame_s = in.number("press_frame_s", Range::positive()),
          .motion_frame_s = in.number("motion_frame_s", Range::positive()),
          .vertices_exponent = in.number("vertices_exponent"),
          .contacts_exponent = in.number("contacts_exponent"),
          .averaged_volume_factor = in.number("averaged_volume_factor", Range::positive())};
}

double modelled_seconds(const CostModel& model, const GelSize& gel, const MotionLength& motion, RenderedFrames frames) {
  // On average over a press, half of a third of the front is in contact.
  const double touching = gel.front_vertices / 6.0;
  const double frame = std::pow(gel.vertices / 1000.0, model.vertices_exponent) *
                       std::pow(1.0 + touching / 100.0, model.contacts_exponent) *
                       (gel.poissons_ratio >= kAveragedVolumeFrom ? model.averaged_volume_factor : 1.0);
  constexpr double kStart_s = 0.1, kPixel_s = 5e-6;  // start of both stages; render time per pixel of a frame
  return frame * (model.press_frame_s * motion.press_frames + model.motion_frame_s * motion.other_frames) + kStart_s +
         kPixel_s * gel.pixels * count_rendered(frames, motion.press_frames + motion.other_frames, motion.kinds);
}

double modelled_bytes(const GelSize& gel, const MotionLength& motion, RenderedFrames frames) {
  // Bytes. Per frame of press: a position for each vertex; two forces and a state for each front vertex; the rest,
  // mostly tractions and markers. Per rendered pixel: its pictures, with the usual maps.
  constexpr double kVertex = 24.0, kFrontVertex = 49.0, kFrame = 63000.0, kPixel = 8.0;
  const int all = motion.press_frames + motion.other_frames + 1;
  return all * (kVertex * gel.vertices + kFrontVertex * gel.front_vertices + kFrame) +
         kPixel * gel.pixels * count_rendered(frames, motion.press_frames + motion.other_frames, motion.kinds);
}

CostEstimate estimate_cost(const fs::path& dataset, const CostModel& model) {
  const fs::path table = samples_table(dataset);
  const RenderedFrames frames = frames_of_render(dataset);
  const auto is_made = [&](const PlannedRow& row) { return fs::exists(dataset / row.folder / "render/render.yaml"); };
  std::size_t made = 0;
  for_each_planned(table, std::nullopt, [&](const PlannedRow& row) { made += is_made(row) ? 1 : 0; });

  const auto ensemble = ensemble_of_dataset(dataset);
  std::map<std::string, GelSize> gels;
  std::map<std::string, MotionLength> motions;
  std::map<std::pair<std::string, std::string>, Group> groups;
  std::size_t made_before = 0;
  const auto size_of_gel = [&](const std::string& gel) {
    if (!gels.contains(gel)) gels[gel] = size_of(Record::from_file(dataset / "gels" / gel / "tetmesh.yaml"));
    return gels[gel];
  };
  for_each_planned(table, std::nullopt, [&](const PlannedRow& row) {
    const std::string gel = row.sensor + "-" + row.mesh;
    size_of_gel(gel);
    const bool has_presses = ensemble && row.sensor == ensemble->sensor && !is_finger(dataset / row.folder);
    const std::vector<std::string> presses = has_presses ? ensemble->presses() : std::vector<std::string>();
    if (!motions.contains(row.motion)) motions[row.motion] = length_of(dataset / row.folder);
    Group& group = groups[{gel, row.motion}];
    if (group.planned++ == 0) {
      group.modelled_seconds = modelled_seconds(model, gels[gel], motions[row.motion], frames);
      group.modelled_bytes = modelled_bytes(gels[gel], motions[row.motion], frames);
      if (has_presses) {
        GelSize of_members = size_of_gel(row.sensor + "-" + (ensemble->mesh.empty() ? row.mesh : ensemble->mesh));
        of_members.pixels = 0.0;  // members are not rendered
        const auto count = static_cast<double>(presses.size());
        group.modelled_seconds += count * modelled_seconds(model, of_members, motions[row.motion], frames);
        group.modelled_bytes += count * modelled_bytes(of_members, motions[row.motion], frames);
      }
    }
    if (!is_made(row)) return;
    if (const auto seconds = processor_seconds(dataset / row.folder, presses)) {
      ++group.timed;
      group.seconds += *seconds;
    }
    if (is_weighed(made_before++, made)) {
      ++group.weighed;
      group.bytes += disk_bytes(dataset / row.folder);
    }
  });

  double seconds = 0.0, by_model_s = 0.0, bytes = 0.0, by_model_bytes = 0.0;
  for (const auto& [name, group] : groups) {
    seconds += group.seconds;
    by_model_s += static_cast<double>(group.timed) * group.modelled_seconds;
    bytes += group.bytes;
    by_model_bytes += static_cast<double>(group.weighed) * group.modelled_bytes;
  }
  const double scale_s = by_model_s > 0.0 ? seconds / by_model_s : 1.0;
  const double scale_bytes = by_model_bytes > 0.0 ? bytes / by_model_bytes : 1.0;
  CostEstimate estimate{.seconds_spent = seconds};
  for (const auto& [name, group] : groups) {
    const double planned = static_cast<double>(group.planned), timed = static_cast<double>(group.timed);
    const double each_s = group.timed > 0 ? group.seconds / timed : scale_s * group.modelled_seconds;
    const double each_bytes =
        group.weighed > 0 ? group.bytes / static_cast<double>(group.weighed) : scale_bytes * group.modelled_bytes;
    estimate.samples += group.planned;
    estimate.made += group.timed;
    estimate.unmeasured += group.timed > 0 ? 0 : group.planned;
    estimate.seconds += planned * each_s;
    estimate.bytes += planned * each_bytes;
    estimate.bytes_left += (planned - timed) * each_bytes;
  }
  return estimate;
}

std::string to_text(const CostEstimate& estimate, const fs::path& dataset) {
  std::string text = fmt::format("{}: {} samples: {:.3g} core-hours ({:.3g} s a sample), {:.3g} GB on disk\n",
                                 name_of_dataset(dataset), estimate.samples, estimate.seconds / 3600.0,
                                 estimate.seconds / static_cast<double>(estimate.samples), estimate.bytes / 1e9);
  if (estimate.made == 0)
    return text +
           "  by the cost model alone, within a factor of three or so; PILOT=20 makes twenty samples first and "
           "measures\n";
  text += fmt::format("  measured on {} made samples, {:.3g} core-hours so far", estimate.made,
                      estimate.seconds_spent / 3600.0);
  if (estimate.unmeasured > 0)
    text += fmt::format("; {} samples of other motions or gels by the cost model", estimate.unmeasured);
  return text + "\n";
}

std::vector<std::string> pilot_samples(const fs::path& dataset, std::size_t count) {
  const fs::path table = samples_table(dataset);
  std::size_t all = 0;
  for_each_planned(table, std::nullopt, [&](const PlannedRow&) { ++all; });
  constexpr double kGoldenRatio = 0.6180339887;
  std::set<std::size_t> taken;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 0.5 + static_cast<double>(i) * kGoldenRatio;
    taken.insert(static_cast<std::size_t>(static_cast<double>(all) * (x - std::floor(x))));
  }
  std::vector<std::string> folders;
  std::size_t i = 0;
  for_each_planned(table, std::nullopt, [&](const PlannedRow& row) {
    if (taken.contains(i++)) folders.push_back(fs::path(row.folder).lexically_relative("samples").string());
  });
  return folders;
}

}  // namespace tacipc
