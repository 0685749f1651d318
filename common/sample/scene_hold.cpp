#include "common/sample/scene_hold.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "common/stage/record.h"

namespace tacipc {
namespace {

std::vector<std::size_t> gels_of(const SceneBodies& scene) {
  std::vector<std::size_t> gels;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (scene.kinds[b] == "gel") gels.push_back(b);
  return gels;
}

Matrix4 hand_pose(const SceneBodies& scene, std::size_t frame) {
  const std::vector<std::size_t> gels = gels_of(scene);
  Matrix4 pose = scene.body_pose[frame][gels.front()];
  for (std::size_t g = 1; g < gels.size(); ++g)
    pose.topRightCorner<3, 1>() += scene.body_pose[frame][gels[g]].topRightCorner<3, 1>();
  pose.topRightCorner<3, 1>() /= static_cast<double>(gels.size());
  return pose;
}

bool touches(const SceneBodies& scene, std::size_t gel, std::size_t frame) {
  const std::size_t count = scene.bodies.size();
  Vector3 force_n = Vector3::Zero();
  for (std::size_t by = 0; by < count; ++by) force_n += scene.per_frame[frame][gel * count + by].force_n;
  return normal_force_n(scene.body_pose[frame][gel], force_n) > kGelTouches_n;
}

/// Returns the frame from which every gel that ever touches anything has done so.
std::optional<std::size_t> gripped_from(const SceneBodies& scene) {
  std::optional<std::size_t> from;
  for (const std::size_t gel : gels_of(scene)) {
    std::size_t f = 0;
    while (f < scene.per_frame.size() && !touches(scene, gel, f)) ++f;
    if (f < scene.per_frame.size()) from = std::max(from.value_or(0), f);
  }
  return from;
}

bool is_touched(const SceneBodies& scene, std::size_t body) {
  for (const std::vector<Wrench>& wrenches : scene.per_frame) {
    for (const std::size_t gel : gels_of(scene))
      if (wrenches[gel * scene.bodies.size() + body].force_n.norm() > kGelTouches_n) return true;
  }
  return false;
}

}  // namespace

double normal_force_n(const Matrix4& world_from_gel, const Vector3& force_n) {
  return 0.0 - force_n.dot(world_from_gel.block<3, 1>(0, 2));
}

namespace {

/// Follows a body as held_motion() defines its motion.
HeldPath held_path(const SceneBodies& scene, std::size_t body, std::size_t freed, std::size_t end,
                   const HeldContacts& contacts) {
  const auto in_hand = [&](std::size_t f) -> Matrix4 {
    return hand_pose(scene, f).inverse() * scene.body_pose[f][body];
  };
  const Vector3 grip = in_hand(freed).inverse().topRightCorner<3, 1>();
  HeldPath path(in_hand(freed), grip, contacts.slip_speed_m_s);
  for (std::size_t f = freed + 1; f <= end; ++f) path.go_on(in_hand(f), contacts.per_frame[f]);
  return path;
}

}  // namespace

HeldMotion held_motion(const SceneBodies& scene, std::size_t body, std::size_t freed, std::size_t frame) {
  const Matrix4 hand_then = hand_pose(scene, freed), hand_now = hand_pose(scene, frame);
  const Matrix4 &body_then = scene.body_pose[freed][body], &body_now = scene.body_pose[frame][body];
  const Matrix4 then = hand_then.inverse() * body_then, now = hand_now.inverse() * body_now;
  const Vector3 grip = then.inverse().topRightCorner<3, 1>();
  const auto at = [&](const Matrix4& pose) -> Vector3 { return (pose * grip.homogeneous()).head<3>(); };
  const Matrix3 turned = now.topLeftCorner<3, 3>() * then.topLeftCorner<3, 3>().transpose();
  const std::vector<std::size_t> gels = gels_of(scene);
  return {.touched = std::all_of(gels.begin(), gels.end(), [&](std::size_t gel) { return touches(scene, gel, frame); }),
          .slip_m = (at(now) - at(then)).norm(),
          .turn_rad = Eigen::AngleAxisd(turned).angle(),
          .rise_m = (at(body_now) - at(body_then)).z(),
          .hand_rise_m = (hand_now - hand_then)(2, 3)};
}

std::vector<HeldBodyLines> held_bodies(const SceneBodies& scene, const std::vector<std::size_t>& free_from,
                                       const HeldContacts& contacts) {
  std::vector<HeldBodyLines> held;
  const auto gripped = gripped_from(scene);
  if (!gripped) return held;
  const std::size_t end = scene.per_frame.size() - 1;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const std::size_t freed = std::max(*gripped, free_from[b]);
    if (scene.kinds[b] != "rigid" || freed >= end || !is_touched(scene, b)) continue;
    HeldMotion motion = held_motion(scene, b, freed, end);
    HeldBodyLines& body = held.emplace_back(HeldBodyLines{.body = scene.bodies[b],
                                                          .freed_frame = freed,
                                                          .slip_m = motion.slip_m,
                                                          .turn_rad = motion.turn_rad,
                                                          .rise_m = motion.rise_m,
                                                          .hand_rise_m = motion.hand_rise_m});
    if (!contacts.per_frame.empty()) {
      const HeldPath path = held_path(scene, b, freed, end, contacts);
      body.creep_m = path.creep_m();
      body.creep_rad = path.creep_rad();
      motion.slip_m = path.slip_m();
      motion.turn_rad = path.slip_rad();
    }
    if (gels_of(scene).size() < 2) continue;
    const GraspOutcome outcome = outcome_of(motion);
    const bool stays = outcome == GraspOutcome::lifted && motion.hand_rise_m < kSlipped_m;
    body.outcome = stays ? "held" : kGraspOutcomes[static_cast<std::size_t>(outcome)];
  }
  return held;
}

std::vector<HeldBodyLines> read_held(const std::filesystem::path& scene_folder) {
  std::vector<HeldBodyLines> held;
  const auto summary = summary_of<SceneSummary>(Record::from_file(scene_folder / "press.yaml"));
  for (const auto& body : summary.sections(&SceneSummary::held)) held.push_back(body.all());
  return held;
}

}  // namespace tacipc
