#include "common/sample/scene_folder.h"

#include <array>

#include "common/base/error.h"
#include "common/format/npy_field.h"
#include "common/sample/press_folder.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

// Rows of finger_pose.npy.
constexpr std::array<const char*, 2> kFingers{"left", "right"};

const NpyField kTimes{.file = "time.npy", .shape = {kFrames}, .unit = "s"};
const NpyField kObjectPoses{.file = "object_pose.npy", .shape = {kFrames, 4, 4}, .unit = "m"};
const NpyField kFingerPoses{
    .file = "finger_pose.npy", .shape = {kFrames, static_cast<int>(kFingers.size()), 4, 4}, .unit = "m"};

Matrix4 pose_at(const std::vector<double>& values, std::size_t index) {
  return Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data() + 16 * index);
}

}  // namespace

bool is_scene_folder(const fs::path& folder) { return fs::is_regular_file(folder / kFingerPoses.file); }

SceneFolder read_scene_folder(const fs::path& folder) {
  if (!fs::is_regular_file(folder / "press.yaml"))
    throw DataError("{}: has no press.yaml, so the press did not finish", folder.string());
  Extents known;
  const auto values = [&](const NpyField& field) { return read_field(field, folder / field.file, known).data; };
  SceneFolder scene{.times_s = values(kTimes), .gels = {}, .objects = {{.name = "object", .world_from_object = {}}}};
  if (scene.times_s.empty()) throw DataError("{}: has no frames", (folder / kTimes.file).string());
  const std::vector<double> objects = values(kObjectPoses), fingers = values(kFingerPoses);
  for (const char* name : kFingers) scene.gels.push_back({name, folder / name, {}});
  for (std::size_t f = 0; f < scene.times_s.size(); ++f) {
    scene.objects.front().world_from_object.push_back(pose_at(objects, f));
    for (std::size_t g = 0; g < scene.gels.size(); ++g)
      scene.gels[g].world_from_gel.push_back(pose_at(fingers, f * scene.gels.size() + g));
  }
  return scene;
}

}  // namespace tacipc
