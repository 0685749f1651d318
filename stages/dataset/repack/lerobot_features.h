// Features of LeRobot datasets: names, units, and their computation from packed samples.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/repack/episodes.h"

namespace tacipc {

/// Rule by which a feature is computed from its field.
enum class FeatureRule {
  picture,
  depth,
  numbers,
  flat,
  displacement,
  wrench,
  pose,
  next_pose,
  both,
  hand,
  next_hand,
  object
};

/// One feature of an episode's frames.
struct Feature {
  std::string name;
  std::string field;  // field of `obs`; for hand, next_hand and object a field of `series`
  FeatureRule rule;
  std::vector<const char*> names = {};  // names of the numbers; of all axes for images; of the last axis if flat
  const char* unit = "";
  std::size_t finger = 0;

  bool is_image() const { return rule == FeatureRule::picture || rule == FeatureRule::depth; }
  /// True if rows of equal size follow each other in one list: LeRobot's tools cannot write lists of lists.
  bool is_flat() const { return rule == FeatureRule::flat || rule == FeatureRule::displacement; }
  bool in(const Episode& episode) const;
  /// Shape of the field in a frame, in LeRobot's order for images.
  std::vector<std::size_t> extents(const Episode& episode) const;
  /// Numbers of a frame in the feature's unit.
  /// \pre not is_image()
  std::vector<double> frame(const Episode& episode, std::size_t frame) const;
};

/// Task text such as "press star, then shear"; the motion's name if the shard does not have the phases.
std::string task_of(const Episode& episode);

/// The only table of names and units: for episodes of one sensor, or for grasps.
const std::vector<Feature>& lerobot_features(bool grasp);

}  // namespace tacipc
