#include "stages/dataset/pack/shard_writer.h"

#include <fmt/ranges.h>

#include <functional>
#include <map>
#include <numeric>

#include "common/base/error.h"
#include "common/base/packed_units.h"
#include "common/base/sha256.h"

namespace tacipc {
namespace {

/// Datasets with smaller frames are contiguous: a chunk for each frame would cost more than it holds.
constexpr std::size_t kSmallestChunk = 2048;

std::size_t count_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::string shape_text(const std::vector<std::size_t>& shape) {
  return shape.empty() ? "one number" : fmt::format("{}", fmt::join(shape, " x "));
}

}  // namespace

Value::Map sample_attributes(const PlannedRow& plan, const std::string& sensor_id, const SampleFrames& sample) {
  const auto summary = sample.press_summary();
  const Record limits = summary.section(&PressSummary::limits).record();
  const Sensor& sensor = sample.sensor();
  Value::Map lines{
      {"id", plan.id},
      {"index", std::int64_t{std::stoll(plan.index)}},
      {"split", plan.split},
      {"split_pose", plan.split_pose},
      {"seed", plan.seed},
      {"sensor_id", sensor_id},
      {"mesh", plan.mesh},
      {"object_id", plan.object},
      {"motion", plan.motion},
      {"status", "made"},
      {"n_frames", sample.frames().size()},
      {"num_samples", sample.frames().size()},  // robomimic's name
      {"press_frames", sample.press_frames()},
      {"mu", summary.required(&PressSummary::friction_coefficient)},
      {"material_law", sensor.material.law},
      {"E_Pa", sensor.material.youngs_modulus_pa},
      {"nu", sensor.material.poissons_ratio},
      {"density_kg_m3", sensor.material.density_kg_m3},
      {"gel_thickness_mm", kMmPerM * sensor.gel.thickness_m},
      {"element", summary.required(&PressSummary::element)},
      {"d_hat_mm", kMmPerM * summary.required(&PressSummary::d_hat_m)},
      {"verdict", summary.required(&PressSummary::verdict)},
      {"image_reference", sample.render().text("reference").value_or("") == "synthetic" ? "synthetic" : "photograph"},
      {"clipped_fraction", sample.render().section("summary").required_number("clipped_fraction")},
      {"press_version", sample.press().required_text("version")},
      {"render_version", sample.render().required_text("version")},
      {"press_sha256", sha256_of_file(sample.folder() / "press/press.yaml")},
      {"render_sha256", sha256_of_file(sample.folder() / "render/render.yaml")},
      {"sample_yaml", sample.config_text("press", "sample")},
      {"press_yaml", sample.config_text("press", "config")},
      {"render_yaml", sample.config_text("render", "config")}};
  if (sample.press().section("inputs").has("path")) lines.emplace_back("path_csv", sample.config_text("press", "path"));
  if (sample.grasp()) {
    using Lines = GraspSummary;
    const auto grasp = sample.grasp_summary();
    const auto pose = grasp.section(&Lines::pose);
    const auto slip = sample.slip();
    const auto list = [](const Vector3& v) { return Value::List(v.begin(), v.end()); };
    const std::filesystem::path folder = plan.folder;
    lines.insert(lines.end(),
                 {{"grasp", folder.parent_path().filename().string()},
                  {"finger", folder.filename().string()},
                  {"outcome", grasp.required(&Lines::outcome)},
                  {"freed_frame", grasp.required(&Lines::freed_frame)},
                  {"judged_frame", grasp.required(&Lines::judged_frame)},
                  {"end_slip_mm", kMmPerM * grasp.required(&Lines::slip_m)},
                  {"end_turn_deg", grasp.required(&Lines::turn_rad) * kDegPerRad},
                  {"end_creep_mm", kMmPerM * grasp.find(&Lines::creep_m).value_or(0.0)},
                  {"end_creep_deg", grasp.find(&Lines::creep_rad).value_or(0.0) * kDegPerRad},
                  {"slip_speed_mm_s", kMmPerM * grasp.find(&Lines::slip_speed_m_s).value_or(0.0)},
                  {"rise_mm", kMmPerM * grasp.required(&Lines::rise_m)},
                  {"hand_rise_mm", kMmPerM * grasp.required(&Lines::hand_rise_m)},
                  {"object_mass_g", 1e3 * grasp.required(&Lines::object_mass_kg)},
                  {"grip_N", grasp.required(&Lines::grip_n)},
                  {"lever_mm", kMmPerM * pose.required(&HeldPoseLines::lever_m)},
                  {"grip_mm", list(kMmPerM * pose.required(&HeldPoseLines::grip_m))},
                  {"center_of_mass_mm", list(kMmPerM * grasp.required(&Lines::center_of_mass_m))},
                  {"center_of_mass_shift_mm", list(kMmPerM * grasp.required(&Lines::center_of_mass_shift_m))},
                  {"gravity_m_s2", list(grasp.required(&Lines::gravity_m_s2))}});
    if (const auto reason = grasp.find(&Lines::reason)) lines.emplace_back("reason", *reason);
    for (const auto time : {&SlipLines::first_slip_s, &SlipLines::gross_slip_s})
      if (const auto time_s = slip.find(time)) lines.emplace_back(key_of(time), *time_s);
    if (const auto margin = grasp.find(&Lines::friction_margin)) lines.emplace_back("friction_margin", *margin);
    if (const auto width = pose.find(&HeldPoseLines::width_m)) lines.emplace_back("width_mm", kMmPerM * *width);
  }
  for (const std::string& name : limits.keys()) lines.emplace_back("limit_" + name, limits.required_number(name));
  return lines;
}

ShardWriter::ShardWriter(const std::filesystem::path& path, const PackConfig& config, const Value::Map& root)
    : config_(config), file_(path) {
  for (const auto& [name, value] : root) file_.attribute("/", name, value);
  file_.group("/data");
  file_.group("/mask");
  file_.group("/sensors");
}

void ShardWriter::add_sensor(const std::string& id, const Value::Map& camera) {
  for (const auto& [known, lines] : sensors_)
    if (known == id) return;
  const std::string group = "/sensors/" + id;
  file_.group(group);
  for (const auto& [name, value] : camera) file_.attribute(group, name, value);
  sensors_.emplace_back(id, camera);
}

void ShardWriter::write_field(const Field& field, const std::string& group, SampleFrames& sample) {
  const std::string path = group + "/" + field.name;
  std::vector<std::size_t> frames = sample.frames();
  if (field.of_press_frames()) {
    frames.resize(sample.press_frames());
    std::iota(frames.begin(), frames.end(), 0);
  }
  std::vector<std::size_t> frame_shape;
  for (std::size_t i = 0; i < (field.per_frame ? frames.size() : 1); ++i) {
    const FieldData data = field.from.read(sample, frames[i]);
    const auto* absent = std::get_if<Absent>(&data);
    if (absent && i == 0) {
      file_.attribute(group, "absent_" + field.name, absent->reason);
      return;
    }
    if (absent)
      throw DataError("{}: {}: frame {} has none, frame 0 has", sample.folder().string(), field.path(), frames[i]);
    const std::string bytes = bytes_of(field, data);
    if (i == 0) {
      frame_shape = shape_of(data);
      if (!field.per_frame) {
        file_.write(path, field.type, frame_shape, bytes);
        break;
      }
      std::vector<std::size_t> shape = frame_shape;
      shape.insert(shape.begin(), frames.size());
      file_.dataset(path, field.type, shape, count_of(frame_shape) * size_of(field.type) >= kSmallestChunk);
    }
    if (shape_of(data) != frame_shape)
      throw DataError("{}: {}: frame {} is {}, frame 0 is {}", sample.folder().string(), field.path(), frames[i],
                      shape_text(shape_of(data)), shape_text(frame_shape));
    file_.write_frame(path, i, bytes);
  }
  for (const auto& [name, value] : attributes_of(field)) file_.attribute(path, name, value);
}

void ShardWriter::write_section(Section section, const std::string& group, SampleFrames& sample, bool variant) {
  for (const Field* field : config_.packed) {
    if (field->section != section || (variant && !field->from.in_variants)) continue;
    file_.group(group);
    write_field(*field, group, sample);
  }
}

void ShardWriter::add_sample(const PlannedRow& plan, const std::string& sensor_id, SampleFrames& sample) {
  const std::string group = "/data/" + plan.id;
  file_.group(group);
  for (const auto& [name, value] : sample_attributes(plan, sensor_id, sample)) file_.attribute(group, name, value);
  for (const Section section : {Section::obs, Section::sim, Section::check})
    write_section(section, fmt::format("{}/{}", group, name_of(section)), sample, false);
  if (sample.grasp())
    write_section(Section::series, group + "/series", sample, false);
  else
    file_.attribute(group, "absent_series", "no grasp");
  if (sample.has_ensemble()) {
    write_section(Section::ensemble, group + "/ensemble", sample, false);
    const EnsembleLabels& ensemble = sample.ensemble();
    for (const auto& [key, value] :
         Value::Map{{"title", ensemble.ensemble().title},
                    {"members", fmt::format("{}", fmt::join(ensemble.made(), " "))},
                    {"missing", fmt::format("{}", fmt::join(ensemble.missing(), " "))},
                    {"num_members", ensemble.made().size()},
                    {"mesh", ensemble.ensemble().mesh.empty() ? plan.mesh : ensemble.ensemble().mesh}})
      file_.attribute(group + "/ensemble", key, value);
  }
  for (const std::string& variant : config_.variants ? sample.variants() : std::vector<std::string>()) {
    sample.look_at(variant);
    write_section(Section::obs, group + "/variants/" + variant, sample, true);
    sample.look_at("");
  }
  ids_.push_back(plan.id);
  splits_.emplace_back(plan.split, plan.id);
  splits_.emplace_back("pose_" + plan.split_pose, plan.id);
  frames_ += sample.frames().size();
}

void ShardWriter::close() {
  std::map<std::string, std::vector<std::string>> lists;
  for (const auto& [list, id] : splits_) lists[list].push_back(id);
  for (const auto& [list, ids] : lists) file_.write_texts("/mask/" + list, ids);
  file_.attribute("/data", "total", frames_);  // robomimic's name
  file_.attribute("/", "samples", ids_.size());
  if (sensors_.size() == 1) {
    for (const auto& [name, value] : sensors_.front().second) file_.attribute("/", name, value);
  } else {
    file_.attribute("/", "absent_camera", fmt::format("the shard is of {} sensors: see /sensors", sensors_.size()));
  }
  file_.close();
}

}  // namespace tacipc
