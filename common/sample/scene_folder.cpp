#include "common/sample/scene_folder.h"

#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;
using enum NpyType;

// Names of the rows of finger_pose.npy.
constexpr std::array<const char*, 2> kFingers{"left", "right"};
constexpr int kFingerCount = kFingers.size();

NpyField energy_field() {
  return {"energy.npy",
          f8,
          {kFrames, kEnergies},
          "J",
          "of gels and bodies but fixed ones: kinetic, elastic (of gels and soft bodies, long-term), of the contact "
          "barrier, gravitational (from the world's origin); since the start: work of mounts and of whoever holds or "
          "loads a body, lost by friction, by damping, by the time integration"};
}

NpyField momentum_field() {
  return {"momentum.npy",
          f8,
          {kFrames, kMomenta, 3},
          "N s, N m s",
          "of gels and bodies but fixed ones, about the world's origin: momentum, angular momentum; since the start: "
          "impulse and angular impulse of weight, mounts and whoever holds or loads a body, angular momentum that the "
          "time integration added"};
}

const std::array<NpyField, 9>& all_grasp_fields() {
  static const std::array<NpyField, 9> kFields{{
      field_of(PressArray::time),
      {"object_world_pose.npy", f8, {kFrames, 4, 4}, "m", "`world_from_object`"},
      {"object_world_twist.npy",
       f8,
       {kFrames, 6},
       "m/s, rad/s",
       "velocity of the object's centre of mass and its angular velocity, axes of the world"},
      {"hand_pose.npy",
       f8,
       {kFrames, 4, 4},
       "m",
       "`world_from_hand`: its origin is where the object is gripped in frame 0"},
      {"finger_pose.npy",
       f8,
       {kFrames, kFingerCount, 4, 4},
       "m",
       "`world_from_finger` of left and right: S in the world"},
      {"finger_force.npy",
       f8,
       {kFrames, kFingerCount, 3},
       "N",
       "contact force on each finger, of the object and of the other gel, axes of the world"},
      {"finger_drive.npy",
       f8,
       {kFrames, kFingerCount, 3},
       "N, m, m/s",
       "of left and right finger: force that its drive closes with (its grip, where it follows a way), its way since "
       "frame 0, its velocity"},
      energy_field(),
      momentum_field(),
  }};
  return kFields;
}

const std::array<NpyField, 7>& all_scene_fields() {
  static const std::array<NpyField, 7> kFields{{
      field_of(PressArray::time),
      {"body_pose.npy",
       f8,
       {kFrames, kBodies, 4, 4},
       "m",
       "`world_from_body`; of a gel that of its mount, of a soft body the pose at the start"},
      {"body_twist.npy",
       f8,
       {kFrames, kRigidBodies, 6},
       "m/s, rad/s",
       "velocity of the centre of mass, angular velocity, axes of the world; none without rigid bodies"},
      {"pair_wrench.npy",
       f8,
       {kFrames, kBodies, kBodies, 6},
       "N, N m",
       "[a, b]: force and torque about the world's origin on body a by body b"},
      energy_field(),
      momentum_field(),
      {"soft/<name>/world_positions.npy", f8, {kFrames, kVertices, 3}, "m", "vertices of `object.msh`, in the world"},
  }};
  return kFields;
}

/// Opens a finished scene; returns its arrays and the bodies that its record lists, in the order of the arrays.
std::pair<ArrayFolder, std::vector<RecordLines<SceneBodyLines>>> open_scene(const fs::path& folder) {
  ArrayFolder arrays = ArrayFolder::finished(folder, "press");
  auto bodies = RecordLines<SceneSummary>(arrays.summary()).sections(&SceneSummary::bodies);
  arrays.know({{kBodies, bodies.size()}});
  return {std::move(arrays), std::move(bodies)};
}

/// Returns the poses of one of several bodies.
std::vector<Matrix4> poses_of(const std::vector<Matrix4>& all, std::size_t body, std::size_t bodies) {
  std::vector<Matrix4> poses;
  for (std::size_t at = body; at < all.size(); at += bodies) poses.push_back(all[at]);
  return poses;
}

SceneFolder read_grasp(const fs::path& folder) {
  const ArrayFolder arrays = ArrayFolder::finished(folder, "press");
  SceneFolder scene{.times_s = arrays.whole(field_of(GraspArray::time)), .gels = {}, .objects = {}};
  scene.objects.push_back({"object", arrays.items<Matrix4>(field_of(GraspArray::object_world_pose))});
  const auto fingers = arrays.items<Matrix4>(field_of(GraspArray::finger_pose));
  for (std::size_t g = 0; g < kFingers.size(); ++g)
    scene.gels.push_back({kFingers[g], folder / kFingers[g], poses_of(fingers, g, kFingers.size())});
  return scene;
}

SceneFolder read_bodies(const fs::path& folder) {
  const auto [arrays, bodies] = open_scene(folder);
  SceneFolder scene{.times_s = arrays.whole(field_of(SceneArray::time)), .gels = {}, .objects = {}};
  const auto all = arrays.items<Matrix4>(field_of(SceneArray::body_pose));
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const std::string name = bodies[b].required(&SceneBodyLines::name),
                      kind = bodies[b].required(&SceneBodyLines::kind);
    std::vector<Matrix4> poses = poses_of(all, b, bodies.size());
    if (kind == "gel") {
      scene.gels.push_back({name, folder / "gels" / name, std::move(poses)});
    } else if (kind == "soft") {
      scene.soft.push_back({name, body_input(name), folder});
    } else {
      scene.objects.push_back({name, std::move(poses), body_input(name),
                               bodies[b].required(&SceneBodyLines::metres_per_unit), kind == "fixed"});
    }
  }
  return scene;
}

bool has(const fs::path& folder, const NpyField& field) { return fs::is_regular_file(folder / field.file); }

bool has_bodies(const fs::path& folder) { return has(folder, field_of(SceneArray::body_pose)); }

}  // namespace

std::span<const NpyField> grasp_fields() { return all_grasp_fields(); }
std::span<const NpyField> scene_fields() { return all_scene_fields(); }

const NpyField& field_of(GraspArray array) { return all_grasp_fields()[static_cast<std::size_t>(array)]; }
const NpyField& field_of(SceneArray array) { return all_scene_fields()[static_cast<std::size_t>(array)]; }

std::vector<Positions> SceneSoft::positions(std::size_t frames, std::size_t vertices) const {
  const ArrayFolder arrays(folder, "press", {{kFrames, frames}, {kVertices, vertices}});
  const std::vector<double> values = arrays.whole(field_named(field_of(SceneArray::soft_positions), name));
  std::vector<Positions> all;
  for (std::size_t f = 0; f < frames; ++f)
    all.emplace_back(
        Eigen::Map<const Positions>(values.data() + 3 * vertices * f, static_cast<Eigen::Index>(vertices), 3));
  return all;
}

bool is_scene_folder(const fs::path& folder) {
  return has_bodies(folder) || has(folder, field_of(GraspArray::finger_pose));
}

SceneFolder read_scene_folder(const fs::path& folder) {
  return has_bodies(folder) ? read_bodies(folder) : read_grasp(folder);
}

SceneBodies read_scene_bodies(const fs::path& folder) {
  const auto [arrays, listed] = open_scene(folder);
  SceneBodies scene;
  for (const auto& body : listed) {
    scene.bodies.push_back(body.required(&SceneBodyLines::name));
    scene.kinds.push_back(body.required(&SceneBodyLines::kind));
  }
  const std::size_t frames = arrays.whole(field_of(SceneArray::time)).size(), count = listed.size();
  const auto poses = arrays.items<Matrix4>(field_of(SceneArray::body_pose));
  const auto wrenches = arrays.items<Wrench>(field_of(SceneArray::pair_wrench));
  for (std::size_t f = 0; f < frames; ++f) {
    const auto rows = [f](const auto& all, std::size_t of_frame) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(f * of_frame);
      return std::vector(begin, begin + static_cast<std::ptrdiff_t>(of_frame));
    };
    scene.per_frame.push_back(rows(wrenches, count * count));
    scene.body_pose.push_back(rows(poses, count));
  }
  scene.energy_j = arrays.items<std::array<double, kEnergies>>(field_of(SceneArray::energy));
  return scene;
}

}  // namespace tacipc
