#include "stages/dataset/repack/lerobot_features.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/sample/motion.h"

namespace tacipc {
namespace {

constexpr double kMetres = 1e-3;
const std::vector<const char*> kImageAxes{"height", "width", "channels"};
const std::vector<const char*> kPoseNames{"x", "y", "z", "qx", "qy", "qz", "qw"};
const std::vector<const char*> kHandNames{"x", "y", "z", "qx", "qy", "qz", "qw", "opening"};
constexpr const char* kPoseUnit = "m, unit quaternion";

/// Features of one sensor; `suffix` and `finger` are for grasps.
std::vector<Feature> of_sensor(const std::string& suffix, std::size_t finger) {
  using enum FeatureRule;
  std::vector<Feature> features{
      {"observation.images.tactile", "rgb", picture, kImageAxes, "code"},
      {"observation.images.tactile_marker", "rgb_marker", picture, kImageAxes, "code"},
      {"observation.images.indentation", "indentation_mm", depth, kImageAxes, "mm"},
      {"observation.tactile.marker_displacement", "marker_mm", displacement, {"x", "y", "z"}, "m"},
      {"observation.tactile.force_field", "force_field_N", flat, {"fx", "fy", "fz"}, "N"},
      {"observation.wrench.tactile", "force_N", wrench, {"fx", "fy", "fz", "tx", "ty", "tz"}, "N, N m"}};
  for (Feature& feature : features) {
    feature.name += suffix;
    feature.finger = finger;
  }
  return features;
}

std::vector<Feature> press_features() {
  using enum FeatureRule;
  std::vector<Feature> features = of_sensor("", 0);
  features.insert(features.end(), {{"observation.force", "press_force_N", numbers, {"press"}, "N"},
                                   {"observation.state", "object_pose", pose, kPoseNames, kPoseUnit},
                                   {"action", "object_pose", next_pose, kPoseNames, kPoseUnit},
                                   {"time", "time_s", numbers, {"time"}, "s"}});
  return features;
}

std::vector<Feature> grasp_features() {
  using enum FeatureRule;
  std::vector<Feature> features = of_sensor("_left", 0);
  const std::vector<Feature> right = of_sensor("_right", 1);
  features.insert(features.end(), right.begin(), right.end());
  features.insert(features.end(), {{"observation.grip", "press_force_N", both, {"left", "right"}, "N"},
                                   {"observation.state", "hand_pose", hand, kHandNames, kPoseUnit},
                                   {"observation.object_pose", "object_pose", object, kPoseNames, kPoseUnit},
                                   {"action", "hand_pose", next_hand, kHandNames, kPoseUnit},
                                   {"time", "time_s", numbers, {"time"}, "s"}});
  return features;
}

void to_metres(std::vector<double>& pose) {
  for (std::size_t i = 0; i < 3; ++i) pose[i] *= kMetres;
}

/// Pose of the hand, and the distance between its fingers' undeformed fronts.
std::vector<double> hand_of(const Episode& episode, std::size_t frame) {
  std::vector<double> state = episode.series("hand_pose", frame);
  const std::vector<double> fingers = episode.series("finger_pose", frame);
  state.push_back(std::hypot(fingers[7] - fingers[0], fingers[8] - fingers[1], fingers[9] - fingers[2]) * kMetres);
  to_metres(state);
  return state;
}

}  // namespace

std::string task_of(const Episode& episode) {
  const std::string pressed = episode.text("object_id");
  if (!episode.sample().has("phase")) return episode.text("motion") + " " + pressed;
  std::vector<std::string> phases;
  for (std::size_t t = 0; t < episode.frames(); ++t) {
    const auto code = static_cast<std::size_t>(episode.sample().numbers("phase", t).at(0));
    const std::string phase = kPhaseNames.at(std::min(code, kPhaseNames.size() - 1));
    const bool moves = code > static_cast<std::size_t>(PhaseKind::approach);
    if (moves && (phases.empty() || phases.back() != phase)) phases.push_back(phase);
  }
  if (phases.empty()) return "touch " + pressed;
  phases.front() += " " + pressed;
  return fmt::format("{}", fmt::join(phases, ", then "));
}

bool Feature::in(const Episode& episode) const {
  using enum FeatureRule;
  if (rule == hand || rule == next_hand || rule == object) return true;  // every grasp has its series
  if (rule == both && !episode.sample(1).has(field)) return false;
  const SampleAt& sample = episode.sample(finger);
  return sample.has(field) && (rule != wrench || sample.has("torque_Nmm"));
}

std::vector<std::size_t> Feature::extents(const Episode& episode) const {
  using enum FeatureRule;
  if (rule == hand || rule == next_hand || rule == object || rule == both || rule == wrench) return {names.size()};
  const SampleAt& sample = episode.sample(finger);
  std::vector<std::size_t> extents = sample.shard.shape(sample.field(field));
  extents.erase(extents.begin());
  if (rule == depth) extents.push_back(1);
  if (extents.empty()) extents = {1};
  return extents;
}

std::vector<double> Feature::frame(const Episode& episode, std::size_t t) const {
  using enum FeatureRule;
  if (rule == next_pose || rule == next_hand) t = std::min(t + 1, episode.frames() - 1);
  if (rule == hand || rule == next_hand) return hand_of(episode, t);
  std::vector<double> values = rule == object ? episode.series(field, t) : episode.sample(finger).numbers(field, t);
  switch (rule) {
    case pose:
    case next_pose:
    case object: to_metres(values); break;
    case displacement: {
      const std::vector<double> rest = episode.sample(finger).numbers(field, 0);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = kMetres * (values[i] - rest[i]);
      break;
    }
    case wrench:
      for (const double torque : episode.sample(finger).numbers("torque_Nmm", t)) values.push_back(kMetres * torque);
      break;
    case both: values.push_back(episode.sample(1).numbers(field, t).at(0)); break;
    default: break;
  }
  return values;
}

const std::vector<Feature>& lerobot_features(bool grasp) {
  static const std::vector<Feature> kPress = press_features(), kGrasp = grasp_features();
  return grasp ? kGrasp : kPress;
}

}  // namespace tacipc
