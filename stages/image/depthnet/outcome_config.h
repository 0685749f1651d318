// configs/depthnet/*.yaml with `task: outcome`: a network that foretells what becomes of a grasp.
#pragma once

#include <variant>

#include "stages/image/depthnet/depthnet_config.h"

namespace tacipc {

struct OutcomeConfig {
  NetworkConfig network;  // the contracting path of the U-Net, for each image
  int hidden = 0;         // numbers that all images of a grasp are joined to
  ScheduleConfig schedule;
  AugmentationConfig augmentation;
  int frames = 0;          // images of each finger: the first so many after the fingers have closed
  int seeds = 0;           // trainings, and as many controls
  std::uint64_t seed = 1;  // of the first one

  static OutcomeConfig read(ConfigReader& in);
};

/// What a file asks for, by its `task`: depth where there is none.
struct TaskConfig {
  std::variant<DepthnetConfig, OutcomeConfig> task;

  static TaskConfig read(ConfigReader& in);
};

}  // namespace tacipc
