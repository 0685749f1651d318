#include "stages/dataset/pack/sample_frames.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/mesh/tet_mesh.h"
#include "common/sample/sample_status.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Frame whose tactile image this output is; nothing for other outputs and for variants.
std::optional<std::size_t> pictured_frame(const fs::path& output) {
  if (output.filename() != field_of(FrameFile::tactile).file) return std::nullopt;
  return frame_number(output.parent_path().string());
}

/// Checks that no files of the sample were removed after an earlier packing; records always stay.
fs::path refuse_dropped(fs::path folder) {
  for (const std::string stage : {"press", "render"})
    if (fs::exists(folder / stage / ".dropped"))
      throw DataError(
          "{}: was dropped after packing and cannot be packed again; clean-{}, then it is made again (or undo what "
          "changed since: plan, profile, other samples)",
          (folder / stage).string(), stage);
  return folder;
}

}  // namespace

SampleFrames::SampleFrames(fs::path folder)
    : folder_(refuse_dropped(std::move(folder))),
      press_(Record::from_file(folder_ / "press/press.yaml")),
      render_(Record::from_file(folder_ / "render/render.yaml")),
      per_frame_(press_summary().sections(&PressSummary::per_frame)),
      arrays_(folder_ / "press", {{kFrames, per_frame_.size()}}) {
  if (is_finger(folder_)) {
    grasp_ = Record::from_file(stage_file(folder_, "press", ".yaml"));
    grasp_per_frame_ = grasp_summary().sections(&GraspSummary::per_frame);
    if (grasp_per_frame_.size() != per_frame_.size())
      throw DataError("{}: the grasp has {} frames, its finger {}", folder_.string(), grasp_per_frame_.size(),
                      per_frame_.size());
    grasp_arrays_.emplace(folder_.parent_path(), "press", Extents{{kFrames, per_frame_.size()}});
    other_finger_.emplace(folder_.parent_path() / (is_right_finger() ? "left" : "right") / "press",
                          Extents{{kFrames, per_frame_.size()}});
  }
  const Record press_inputs = press_.section("inputs"), render_inputs = render_.section("inputs");
  // Images and measurements must belong to the same press.
  if (render_inputs.section("press").required_text("hash") != content_hash(folder_ / "press"))
    throw DataError("{}: the images were made of another press than the one that is there", folder_.string());
  const fs::path sensor = press_input("sensor");
  for (const Record& inputs : {press_inputs, render_inputs}) {
    if (inputs.section("sensor").required_text("hash") != content_hash(sensor))
      throw DataError("{}: is not the sensor that {} was made with", sensor.string(), folder_.string());
  }
  sensor_ = read_config<Sensor>(sensor);

  const Record outputs = render_.section("outputs");
  for (const std::string& name : outputs.keys()) {
    picture_hashes_.emplace(name, outputs.required_text(name));
    if (const auto frame = pictured_frame(name)) frames_.push_back(*frame);
  }
  std::sort(frames_.begin(), frames_.end());
  if (frames_.empty() || frames_.front() != 0) throw DataError("{}: has no image of frame 0", folder_.string());
  if (frames_.back() >= per_frame_.size())
    throw DataError("{}: has an image of frame {}, the press has {} frames", folder_.string(), frames_.back(),
                    per_frame_.size());
  for (const Record& variant : render_.section("summary").sections("variants"))
    variants_.push_back(variant.required_text("name"));
}

fs::path SampleFrames::press_input(const std::string& flag) const {
  const std::string path = press_.section("inputs").section(flag).required_text("path");
  return (folder_ / "press" / path).lexically_normal();
}

std::string SampleFrames::config_text(const std::string& stage, const std::string& flag) const {
  const Record given = (stage == "press" ? press_ : render_).section("inputs").section(flag);
  const fs::path path = (folder_ / stage / given.required_text("path")).lexically_normal();
  if (content_hash(path) != given.required_text("hash"))
    throw DataError("{}: has changed since {} of {} was made with it", path.string(), stage, folder_.string());
  return read_file(path);
}

std::optional<fs::path> SampleFrames::picture(std::size_t frame, const std::string& name) {
  const std::string output = frame_folder(frame, variant_) + name;
  const auto found = picture_hashes_.find(output);
  if (found == picture_hashes_.end()) return std::nullopt;
  const fs::path path = folder_ / "render" / output;
  if (content_hash(path) != found->second) throw DataError("{}: is not the file of its record", path.string());
  return path;
}

FieldData SampleFrames::image(std::size_t frame, FrameFile file, const std::string& reason) {
  const ImageField& field = field_of(file);
  const auto path = picture(frame, field.file);
  if (!path) return Absent{reason};
  if (field.is_float()) return read_exr(*path, field.channels);
  return read_png(*path, static_cast<int>(field.channels.size()));
}

FieldData SampleFrames::marker_px(std::size_t frame, const std::string& reason) {
  const auto path = picture(frame, marker_px_field().file);
  if (!path) return Absent{reason};
  const MarkerPixels px = read_marker_px(*path);
  return Numbers{{static_cast<std::size_t>(px.rows()), 2}, {px.data(), px.data() + px.size()}};
}

FingerFront SampleFrames::finger_front(std::size_t side, std::size_t frame) const {
  const PressFolder& finger = (side == 1) == is_right_finger() ? arrays_ : *other_finger_;
  return {.normal_n = finger.contact_forces(frame).normal.rowwise().norm(), .states = finger.contact_states(frame)};
}

void SampleFrames::add_ensemble(const DatasetEnsemble& ensemble) {
  ensemble_ = std::make_unique<EnsembleLabels>(ensemble, folder_, press_input("object"));
}

Numbers SampleFrames::front_triangles() {
  const fs::path gel_path = press_input("gel");
  if (content_hash(gel_path) != press_.section("inputs").section("gel").required_text("hash"))
    throw DataError("{}: is not the gel that {} was made with", gel_path.string(), folder_.string());
  const TetMesh gel = read_tet_mesh(gel_path);
  const std::vector<int> vertices = gel.vertices(BoundaryTag::front);
  const Triangles front = gel.faces(BoundaryTag::front);
  Numbers numbers{.shape = {static_cast<std::size_t>(front.rows()), 3}, .values = {}};
  for (Eigen::Index i = 0; i < front.size(); ++i) {
    const auto row = std::lower_bound(vertices.begin(), vertices.end(), front.data()[i]) - vertices.begin();
    numbers.values.push_back(static_cast<double>(row));
  }
  return numbers;
}

}  // namespace tacipc
