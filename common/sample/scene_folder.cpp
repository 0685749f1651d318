#include "common/sample/scene_folder.h"

#include <algorithm>
#include <array>

#include "common/base/error.h"
#include "common/format/npy_field.h"
#include "common/format/npy_pose.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

// Rows of finger_pose.npy.
constexpr std::array<const char*, 2> kFingers{"left", "right"};

const NpyField kTimes{.file = "time.npy", .shape = {kFrames}, .unit = "s"};
const NpyField kObjectPoses{.file = "object_pose.npy", .shape = {kFrames, 4, 4}, .unit = "m"};
const NpyField kFingerPoses{
    .file = "finger_pose.npy", .shape = {kFrames, static_cast<int>(kFingers.size()), 4, 4}, .unit = "m"};

constexpr std::string_view kBodies = "bodies";
const NpyField kBodyPoses{.file = "body_pose.npy", .shape = {kFrames, kBodies, 4, 4}, .unit = "m"};
const NpyField kWrenches{.file = "wrench.npy", .shape = {kFrames, kBodies, kBodies, 6}, .unit = "N, N m"};
const NpyField kEnergies{.file = "energy.npy", .shape = {kFrames, 8}, .unit = "J"};
const NpyField kSoftPositions{.file = "positions.npy", .shape = {kFrames, kVertices, 3}, .unit = "m"};

Matrix4 pose_at(const std::vector<double>& values, std::size_t index) { return pose_of(values.data() + 16 * index); }

/// An array of the folder; what the symbols of its shape stand for is kept.
std::vector<double> values_of(const fs::path& folder, const NpyField& field, Extents& known) {
  return read_field(field, folder / field.file, known).data;
}

std::vector<double> read_times(const fs::path& folder, Extents& known) {
  if (!fs::is_regular_file(folder / "press.yaml"))
    throw DataError("{}: has no press.yaml, so the press did not finish", folder.string());
  std::vector<double> times = values_of(folder, kTimes, known);
  if (times.empty()) throw DataError("{}: has no frames", (folder / kTimes.file).string());
  return times;
}

/// The bodies that the record of a scene lists, in the order of its arrays.
std::vector<RecordLines<SceneBodyLines>> listed_bodies(const fs::path& folder, Extents& known) {
  auto bodies = summary_of<SceneSummary>(Record::from_file(folder / "press.yaml")).sections(&SceneSummary::bodies);
  known.emplace(kBodies, bodies.size());
  return bodies;
}

/// Poses of one of several bodies.
std::vector<Matrix4> poses_of(const std::vector<double>& values, std::size_t body, std::size_t bodies) {
  std::vector<Matrix4> poses;
  for (std::size_t at = body; 16 * at < values.size(); at += bodies) poses.push_back(pose_at(values, at));
  return poses;
}

SceneFolder read_grasp(const fs::path& folder) {
  Extents known;
  SceneFolder scene{.times_s = read_times(folder, known), .gels = {}, .objects = {}};
  scene.objects.push_back({"object", poses_of(values_of(folder, kObjectPoses, known), 0, 1)});
  const std::vector<double> fingers = values_of(folder, kFingerPoses, known);
  for (std::size_t g = 0; g < kFingers.size(); ++g)
    scene.gels.push_back({kFingers[g], folder / kFingers[g], poses_of(fingers, g, kFingers.size())});
  return scene;
}

SceneFolder read_bodies(const fs::path& folder) {
  Extents known;
  SceneFolder scene{.times_s = read_times(folder, known), .gels = {}, .objects = {}};
  const auto bodies = listed_bodies(folder, known);
  const std::vector<double> values = values_of(folder, kBodyPoses, known);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::string name = bodies[b].required(&SceneBodyLines::name),
                      kind = bodies[b].required(&SceneBodyLines::kind);
    std::vector<Matrix4> poses = poses_of(values, b, bodies.size());
    if (kind == "gel") {
      scene.gels.push_back({name, folder / "gels" / name, std::move(poses)});
    } else if (kind == "soft") {
      scene.soft.push_back({name, body_input(name), folder / "soft" / name / kSoftPositions.file});
    } else {
      scene.objects.push_back({name, std::move(poses), body_input(name),
                               bodies[b].required(&SceneBodyLines::metres_per_unit), kind == "fixed"});
    }
  }
  return scene;
}

bool has_bodies(const fs::path& folder) { return fs::is_regular_file(folder / kBodyPoses.file); }

}  // namespace

std::vector<Positions> SceneSoft::positions(std::size_t frames, std::size_t vertices) const {
  Extents known{{kFrames, frames}, {kVertices, vertices}};
  const std::vector<double> values = read_field(kSoftPositions, array, known).data;
  std::vector<Positions> all;
  for (std::size_t f = 0; f < frames; ++f)
    all.emplace_back(
        Eigen::Map<const Positions>(values.data() + 3 * vertices * f, static_cast<Eigen::Index>(vertices), 3));
  return all;
}

bool is_scene_folder(const fs::path& folder) {
  return has_bodies(folder) || fs::is_regular_file(folder / kFingerPoses.file);
}

SceneFolder read_scene_folder(const fs::path& folder) {
  return has_bodies(folder) ? read_bodies(folder) : read_grasp(folder);
}

SceneBodies read_scene_bodies(const fs::path& folder) {
  Extents known;
  SceneBodies scene;
  const std::size_t frames = read_times(folder, known).size();
  for (const auto& body : listed_bodies(folder, known)) {
    scene.bodies.push_back(body.required(&SceneBodyLines::name));
    scene.kinds.push_back(body.required(&SceneBodyLines::kind));
  }
  const std::vector<double> poses = values_of(folder, kBodyPoses, known),
                            wrenches = values_of(folder, kWrenches, known),
                            energies = values_of(folder, kEnergies, known);
  const std::size_t count = scene.bodies.size();
  for (std::size_t f = 0; f < frames; ++f) {
    auto& of_frame = scene.per_frame.emplace_back();
    for (std::size_t pair = 0; pair < count * count; ++pair) {
      const double* six = wrenches.data() + 6 * (count * count * f + pair);
      of_frame.push_back({Vector3(six[0], six[1], six[2]), Vector3(six[3], six[4], six[5])});
    }
    auto& energy = scene.energy_j.emplace_back();
    std::copy_n(energies.begin() + static_cast<std::ptrdiff_t>(energy.size() * f), energy.size(), energy.begin());
    auto& at = scene.body_pose.emplace_back();
    for (std::size_t b = 0; b < count; ++b) at.push_back(pose_at(poses, count * f + b));
  }
  return scene;
}

}  // namespace tacipc
