#include "stages/dataset/repack/univtac.h"

#include <algorithm>
#include <map>
#include <set>

#include "common/base/error.h"
#include "common/base/packed_units.h"
#include "common/format/hdf5_writer.h"
#include "common/image/image.h"

namespace tacipc {
namespace {

struct Renamed {
  const char* theirs;
  const char* ours;
};
constexpr Renamed kPictures[] = {{"rgb", "rgb"}, {"rgb_marker", "rgb_marker"}};
constexpr Renamed kMaps[] = {{"depth", "camera_depth_mm"}, {"press_depth", "indentation_mm"}, {"marker", "marker_px"}};

/// Poses in UniVTAC's order.
using Poses = std::vector<double>;  // 7 numbers per frame

/// Appends a pose: x, y, z in mm and qx, qy, qz, qw → metres and qw, qx, qy, qz.
void append_pose(Poses& poses, std::vector<double> pose) {
  for (std::size_t i = 0; i < 3; ++i) pose[i] /= kMmPerM;
  std::rotate(pose.begin() + 3, pose.begin() + 6, pose.end());
  poses.insert(poses.end(), pose.begin(), pose.end());
}

/// File of one episode.
class EpisodeFile {
 public:
  EpisodeFile(const Episode& episode, const std::filesystem::path& path) : episode_(episode), file_(path) {}

  void write() {
    file_.attribute("/", "id", episode_.id());
    file_.attribute("/", "converted_from", "tactile-shard");
    file_.attribute("/", "world",
                    episode_.is_grasp() ? "x from the left finger to the right one before the hand turns, z up"
                                        : "the frame S of the sensor, which does not move");
    file_.attribute("/", "absent_observation", "there is no camera but those in the sensors");
    if (!episode_.is_grasp()) file_.attribute("/", "absent_right_tactile", "the sample has one sensor");
    write_counters();
    write_world();
    write_finger("/tactile/left_tactile", 0);
    if (episode_.is_grasp()) write_finger("/tactile/right_tactile", 1);
    file_.close();
  }

 private:
  void write_counters() {
    const SampleAt& sample = episode_.sample();
    std::vector<double> steps;
    for (std::size_t t = 0; t < episode_.frames(); ++t)
      steps.push_back(sample.has("frame") ? sample.numbers("frame", t).at(0) : static_cast<double>(t));
    file_.write("/step", NumberType::i32, {steps.size()}, to_bytes(NumberType::i32, steps));
    file_.attribute("/step", "meaning", sample.has("frame") ? "frame of the simulation" : "number of the image");
    file_.group("/embodiment");
    file_.write("/embodiment/joint", NumberType::f32, {steps.size(), 0}, "");
    file_.attribute("/embodiment/joint", "absent", "there is no robot: no number in any frame");
  }

  void write_world() {
    Poses object, hand;
    const bool known = episode_.is_grasp() || episode_.sample().has("object_pose");
    for (std::size_t t = 0; t < episode_.frames() && known; ++t) {
      append_pose(object, episode_.is_grasp() ? episode_.series("object_pose", t)
                                              : episode_.sample().numbers("object_pose", t));
      if (episode_.is_grasp()) append_pose(hand, episode_.series("hand_pose", t));
    }
    const std::string id = episode_.name_of("object_id");
    const std::string name =
        id.find("rgb") == std::string::npos ? id : "object";  // UniVTAC reads names that contain "rgb" as images
    file_.group("/actor");
    if (known)
      write_poses("/actor/" + name, object, "the object " + id);
    else
      file_.attribute("/actor", "absent_" + name, "object_pose is not packed");
    if (episode_.is_grasp())
      write_poses("/embodiment/ee", hand, "the hand, whose origin is where the object is gripped in frame 0");
    else
      file_.attribute("/embodiment", "absent_ee", "no hand holds the sensor");
  }

  void write_poses(const std::string& path, const Poses& poses, const std::string& what) {
    file_.write(path, NumberType::f32, {poses.size() / 7, 7}, to_bytes(NumberType::f32, poses));
    file_.attribute(path, "unit", "m and 1");
    file_.attribute(path, "meaning", "pose of " + what + " in the world: x, y, z, then unit quaternion w, x, y, z");
    file_.attribute(path, "quat_order", "wxyz");
  }

  void write_finger(const std::string& group, std::size_t finger) {
    file_.group(group);
    for (const auto& [theirs, ours] : kPictures)
      if (is_there(group, finger, theirs, ours)) write_streams(group + "/" + theirs, episode_.sample(finger), ours);
    for (const auto& [theirs, ours] : kMaps)
      if (is_there(group, finger, theirs, ours)) copy(group + "/" + theirs, episode_.sample(finger), ours);
    Poses sensor;
    for (std::size_t t = 0; t < episode_.frames(); ++t) {
      std::vector<double> pose{0, 0, 0, 0, 0, 0, 1};
      if (episode_.is_grasp()) {
        const std::vector<double> both = episode_.series("finger_pose", t);
        pose.assign(both.begin() + static_cast<std::ptrdiff_t>(7 * finger),
                    both.begin() + static_cast<std::ptrdiff_t>(7 * finger + 7));
      }
      append_pose(sensor, pose);
    }
    write_poses(group + "/pose", sensor, "the sensor's frame S");
  }

  bool is_there(const std::string& group, std::size_t finger, const char* theirs, const char* ours) {
    const SampleAt& sample = episode_.sample(finger);
    if (sample.has(ours)) return true;
    Value reason = "not packed";
    for (const auto& [name, value] : sample.shard.attributes(sample.group + "/obs"))
      if (name == fmt::format("absent_{}", ours)) reason = value;
    file_.attribute(group, fmt::format("absent_{}", theirs), reason);
    return false;
  }

  /// UniVTAC encodes arrays in the order R, G, B with OpenCV, which assumes B, G, R, and decodes them in the same way.
  void write_streams(const std::string& path, const SampleAt& sample, const char* field) {
    const std::vector<std::size_t> shape = sample.shard.shape(sample.field(field));
    std::vector<std::string> streams;
    for (std::size_t t = 0; t < shape[0]; ++t) {
      const std::string bytes = sample.shard.read_frame(sample.field(field), t);
      ByteImage image(static_cast<int>(shape[2]), static_cast<int>(shape[1]), 3);
      image.pixels.assign(bytes.begin(), bytes.end());
      for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3) std::swap(image.pixels[i], image.pixels[i + 2]);
      streams.push_back(png_bytes(image, sample.field(field)));
    }
    file_.write_texts(path, streams);
    file_.attribute(path, "encoding", "PNG whose red and blue are exchanged: cv2.imdecode gives R, G, B");
    file_.attribute(path, "meaning", sample.shard.text_attribute(sample.field(field), "meaning"));
  }

  void copy(const std::string& path, const SampleAt& sample, const char* field) {
    const std::string from = sample.field(field);
    const std::vector<std::size_t> shape = sample.shard.shape(from);
    file_.dataset(path, sample.shard.type(from), shape, true);
    for (std::size_t t = 0; t < shape[0]; ++t) file_.write_frame(path, t, sample.shard.read_frame(from, t));
    for (const char* name : {"unit", "frame", "sign", "meaning"})
      file_.attribute(path, name, sample.shard.text_attribute(from, name));
  }

  const Episode& episode_;
  Hdf5Writer file_;
};

}  // namespace

Value::Map write_univtac(std::vector<std::filesystem::path> shards, const OutputPath& output) {
  struct Count {
    std::size_t episodes = 0, frames = 0;
  };
  std::map<std::string, Count> counts;
  std::set<std::string> names;
  const std::size_t alone = for_each_episode(std::move(shards), [&](std::size_t, const Episode& episode) {
    const SampleAt& sample = episode.sample();
    const std::size_t index = sample.shard.count_attribute(sample.group, "index");  // index in the plan
    const std::string name = fmt::format("{}/{}/hdf5/{}.hdf5", episode.kind(), episode.name_of("split"), index);
    if (!names.insert(name).second) throw DataError("{}: another sample has its index, {}", episode.id(), index);
    EpisodeFile(episode, output(name)).write();
    Count& count = counts[episode.kind()];
    ++count.episodes;
    count.frames += episode.frames();
  });
  Value::Map summary;
  for (const auto& [kind, count] : counts)
    summary.emplace_back(kind, Value::Map{{"episodes", count.episodes}, {"frames", count.frames}});
  if (alone > 0) summary.emplace_back("fingers_left_out", alone);
  return summary;
}

}  // namespace tacipc
