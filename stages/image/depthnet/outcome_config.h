// Content of configs/depthnet/*.yaml with `task: outcome`: a network that predicts the outcome of a grasp.
#pragma once

#include <variant>

#include "stages/image/depthnet/depthnet_config.h"

namespace tacipc {

/// Configuration of an outcome network.
struct OutcomeConfig {
  NetworkConfig network;  // contracting path of the U-Net, for each image
  int hidden = 0;         // size of the hidden layer that joins all images of a grasp
  ScheduleConfig schedule;
  AugmentationConfig augmentation;
  int frames = 0;          // images of each finger: this many, from closing on
  int seeds = 0;           // number of trainings, and of controls
  std::uint64_t seed = 1;  // seed of the first training

  static OutcomeConfig read(ConfigReader& in);
};

/// Configuration by its `task`; depth if it has none.
struct TaskConfig {
  std::variant<DepthnetConfig, OutcomeConfig> task;

  static TaskConfig read(ConfigReader& in);
};

}  // namespace tacipc
