#include "stages/pack/sample_frames.h"

#include <algorithm>
#include <charconv>

#include "common/error.h"
#include "common/files.h"
#include "common/tet_mesh.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// N of "frame_N/tactile.png".
std::optional<std::size_t> frame_number(const std::string& output) {
  constexpr std::string_view kBegin = "frame_", kEnd = "/tactile.png";
  if (!output.starts_with(kBegin) || !output.ends_with(kEnd) || output.size() <= kBegin.size() + kEnd.size())
    return std::nullopt;
  std::size_t number = 0;
  const char* end = output.data() + output.size() - kEnd.size();
  const auto [at, error] = std::from_chars(output.data() + kBegin.size(), end, number);
  if (error != std::errc() || at != end) return std::nullopt;
  return number;
}

std::string frame_folder(std::size_t frame) { return fmt::format("frame_{:04}/", frame); }

/// Files of a dataset that was packed once may have been removed since, records excepted.
fs::path refuse_dropped(fs::path folder) {
  for (const std::string stage : {"press", "render"})
    if (fs::exists(folder / stage / ".dropped"))
      throw DataError(
          "{}: was dropped after packing and cannot be packed again; clean-{}, then it is made anew (or undo what "
          "changed since: plan, profile, other samples)",
          (folder / stage).string(), stage);
  return folder;
}

template <typename T>
Numbers numbers_of(const Image<T>& image) {
  Numbers numbers{.shape = {static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)},
                  .values = {image.pixels.begin(), image.pixels.end()}};
  if (image.channels > 1) numbers.shape.push_back(static_cast<std::size_t>(image.channels));
  return numbers;
}

}  // namespace

SampleFrames::SampleFrames(fs::path folder)
    : folder_(refuse_dropped(std::move(folder))),
      press_(Record::from_file(folder_ / "press/press.yaml")),
      render_(Record::from_file(folder_ / "render/render.yaml")),
      per_frame_(press_.section("summary").sections("per_frame")) {
  const Record press_inputs = press_.section("inputs"), render_inputs = render_.section("inputs");
  // What shows and what is measured must be of the same press.
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
    if (const auto frame = frame_number(name)) frames_.push_back(*frame);
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
  const std::string output = frame_folder(frame) + (variant_.empty() ? "" : variant_ + "/") + name;
  const auto found = picture_hashes_.find(output);
  if (found == picture_hashes_.end()) return std::nullopt;
  const fs::path path = folder_ / "render" / output;
  if (content_hash(path) != found->second)
    throw DataError("{}: is not the file that its record speaks of", path.string());
  return path;
}

FieldData SampleFrames::exr(std::size_t frame, const std::string& name, const std::vector<std::string>& channels,
                            const std::string& reason) {
  const auto path = picture(frame, name);
  if (!path) return Absent{reason};
  return numbers_of(read_exr(*path, channels));
}

FieldData SampleFrames::png(std::size_t frame, const std::string& name, int channels, const std::string& reason) {
  const auto path = picture(frame, name);
  if (!path) return Absent{reason};
  return numbers_of(read_png(*path, channels));
}

FieldData SampleFrames::marker_px(std::size_t frame, const std::string& reason) {
  const auto path = picture(frame, "marker_px.npy");
  if (!path) return Absent{reason};
  NpyArray array = read_npy(*path);
  return Numbers{std::move(array.shape), std::move(array.data)};
}

NpyFrames& SampleFrames::open(const std::string& name) {
  auto& array = arrays_[name];
  if (!array) array = std::make_unique<NpyFrames>(folder_ / "press" / name);
  return *array;
}

Numbers SampleFrames::press_array(std::size_t frame, const std::string& name) {
  NpyFrames& array = open(name);
  if (array.shape()[0] != per_frame_.size())
    throw DataError("{}: has {} frames, the press {}", (folder_ / "press" / name).string(), array.shape()[0],
                    per_frame_.size());
  return {array.frame_shape(), array.frame(frame)};
}

Numbers SampleFrames::whole_press_array(const std::string& name) {
  NpyArray array = read_npy(folder_ / "press" / name);
  return {std::move(array.shape), std::move(array.data)};
}

Numbers SampleFrames::front_positions(std::size_t frame) {
  const Numbers all = press_array(frame, "positions.npy"), rows = whole_press_array("front_vertices.npy");
  Numbers front{.shape = {rows.values.size(), 3}, .values = {}};
  for (const double row : rows.values) {
    const auto begin = all.values.begin() + static_cast<std::ptrdiff_t>(3 * row);
    front.values.insert(front.values.end(), begin, begin + 3);
  }
  return front;
}

double SampleFrames::press_number(std::size_t frame, const std::string& key) const {
  return per_frame_[frame].required_number(key);
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
