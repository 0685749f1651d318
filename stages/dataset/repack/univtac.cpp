#include "stages/dataset/repack/univtac.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/format/hdf5_writer.h"

namespace tacipc {
namespace {

constexpr const char* kGroup = "/tactile/left_tactile";

struct Renamed {
  const char* theirs;
  const char* ours;
};
constexpr Renamed kFields[] = {{"rgb", "rgb"},
                               {"rgb_marker", "rgb_marker"},
                               {"depth", "camera_depth_mm"},
                               {"press_depth", "indentation_mm"},
                               {"marker", "marker_px"},
                               {"pose", "object_pose"}};

/// x, y, z, qx, qy, qz, qw → x, y, z, qw, qx, qy, qz.
std::string scalar_first(const std::string& bytes, NumberType type) {
  std::vector<double> pose = from_bytes(type, bytes);
  std::rotate(pose.begin() + 3, pose.begin() + 6, pose.end());
  return to_bytes(type, pose);
}

}  // namespace

void write_univtac(const Hdf5Reader& shard, const std::string& id, const std::filesystem::path& path) {
  const std::string obs = "/data/" + id + "/obs";
  const Value::Map reasons = shard.attributes(obs);
  Hdf5Writer file(path);
  file.attribute("/", "id", id);
  file.attribute("/", "converted_from", "tactile-shard");
  file.group(kGroup);
  for (const auto& [theirs, ours] : kFields) {
    const std::string from = fmt::format("{}/{}", obs, ours), to = fmt::format("{}/{}", kGroup, theirs);
    if (!shard.has(from)) {
      Value reason = "not packed";
      for (const auto& [name, value] : reasons)
        if (name == fmt::format("absent_{}", ours)) reason = value;
      file.attribute(kGroup, fmt::format("absent_{}", theirs), reason);
      continue;
    }
    const std::vector<std::size_t> shape = shard.shape(from);
    const NumberType type = shard.type(from);
    const bool pose = std::string_view(theirs) == "pose";
    file.dataset(to, type, shape, !pose);
    for (std::size_t t = 0; t < shape[0]; ++t) {
      const std::string bytes = shard.read_frame(from, t);
      file.write_frame(to, t, pose ? scalar_first(bytes, type) : bytes);
    }
    for (const char* name : {"unit", "frame", "sign"}) file.attribute(to, name, shard.text_attribute(from, name));
    file.attribute(to, "meaning",
                   pose ? "position x, y, z in mm, then unit quaternion w, x, y, z (scalar first)"
                        : shard.text_attribute(from, "meaning"));
    if (pose) file.attribute(to, "quat_order", "wxyz");
  }
  file.close();
}

}  // namespace tacipc
