// Content of configs/depthnet/*.yaml: a network that estimates depth from tactile images, and its training.
#pragma once

#include <cstdint>

#include "common/benchmark/unet.h"
#include "common/config/config.h"

namespace tacipc {

/// Section `loss`.
struct LossConfig {
  bool squared = false;         // true: mean squared error; false: mean absolute error
  double contact_weight = 0.0;  // additional weight of a pixel in contact (kContactMm): it counts 1 + contact_weight
  double slope_weight = 0.0;    // weight of the mean error of differences between neighbours
};

/// Section `schedule`.
struct ScheduleConfig {
  int epochs = 0;
  int batch = 0;
  double learning_rate = 0.0;  // largest learning rate, after a linear rise; then it falls like a cosine to 0
  double warmup_epochs = 0.0;
  double weight_decay = 0.0;
  double gradient_norm = 0.0;  // limit to which longer gradients are shortened
};

/// Differences between a sensor and its simulation. Each image has its own draws; U(a) is uniform in ±a.
struct AugmentationConfig {
  double gain = 0.0;             // factor 1 + U on the change against the reference, per channel
  double drift_codes = 0.0;      // U added to the image, per channel
  double noise_codes = 0.0;      // largest standard deviation of a pixel's noise; drawn uniformly up to this
  double reference_codes = 0.0;  // U added to image and reference, per channel
  int shift_px = 0;              // largest shift of image, reference and depth together, pixels of the network
};

/// Read the sections that networks for all tasks have.
NetworkConfig read_network(ConfigReader in);
ScheduleConfig read_schedule(ConfigReader in);
AugmentationConfig read_augmentation(ConfigReader in, bool reference = true);  // false: no key reference_codes

/// Configuration of a depth network.
struct DepthnetConfig {
  NetworkConfig network;
  LossConfig loss;
  ScheduleConfig schedule;
  AugmentationConfig augmentation;
  bool last_frame = false;     // use only the last frame of each sample
  bool shuffle_pairs = false;  // control: every image gets the depth of another image
  std::uint64_t seed = 1;

  static DepthnetConfig read(ConfigReader& in);
};

}  // namespace tacipc
