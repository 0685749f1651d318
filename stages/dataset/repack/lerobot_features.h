// Features of LeRobot datasets: their names and units, and their numbers out of packed samples.
#pragma once

#include <string>
#include <vector>

#include "stages/dataset/repack/episodes.h"

namespace tacipc {

/// How a feature comes from its field.
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

struct Feature {
  std::string name;
  std::string field;  // of `obs`; for hand, next_hand and object of `series`
  FeatureRule rule;
  std::vector<const char*> names = {};  // of the numbers; of all axes for images; of the last axis if flat
  const char* unit = "";
  std::size_t finger = 0;

  bool is_image() const { return rule == FeatureRule::picture || rule == FeatureRule::depth; }
  /// Rows of equal numbers one after the other: LeRobot's tools cannot write lists of lists.
  bool is_flat() const { return rule == FeatureRule::flat || rule == FeatureRule::displacement; }
  bool in(const Episode& episode) const;
  /// Extents of the field in a frame, as LeRobot counts those of images.
  std::vector<std::size_t> extents(const Episode& episode) const;
  /// The numbers of a frame in the feature's unit. \pre not is_image()
  std::vector<double> frame(const Episode& episode, std::size_t frame) const;
};

/// "press star, then shear"; the motion's name if the shard does not have the phases.
std::string task_of(const Episode& episode);

/// The one table of names and units: of episodes of one sensor, and of grasps.
const std::vector<Feature>& lerobot_features(bool grasp);

}  // namespace tacipc
