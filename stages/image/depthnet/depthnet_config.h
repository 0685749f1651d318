// configs/depthnet/*.yaml: a network that reads depth from touch, and how it is trained.
#pragma once

#include <cstdint>

#include "common/benchmark/unet.h"
#include "common/config/config.h"

namespace tacipc {

struct LossConfig {
  bool squared = false;         // mean squared error, else mean absolute error
  double contact_weight = 0.0;  // a pixel in contact (kContactMm) counts 1 + this
  double slope_weight = 0.0;    // of the mean error of differences between neighbours
};

struct ScheduleConfig {
  int epochs = 0;
  int batch = 0;
  double learning_rate = 0.0;  // its largest; rises linearly, then falls like a cosine to 0
  double warmup_epochs = 0.0;
  double weight_decay = 0.0;
  double gradient_norm = 0.0;  // a longer gradient is shortened to this
};

/// What may differ between a sensor and its simulation. Each image draws its own; U(a) is uniform in ±a.
struct AugmentationConfig {
  double gain = 0.0;             // change against the reference × (1 + U), per channel
  double drift_codes = 0.0;      // image + U, per channel
  double noise_codes = 0.0;      // standard deviation of a pixel's noise: uniform up to this
  double reference_codes = 0.0;  // image and reference + U, per channel
  int shift_px = 0;              // of image, reference and depth together, pixels of the network
};

/// Sections that networks for all tasks have.
NetworkConfig read_network(ConfigReader in);
ScheduleConfig read_schedule(ConfigReader in);
AugmentationConfig read_augmentation(ConfigReader in, bool reference = true);  // without reference_codes or with

struct DepthnetConfig {
  NetworkConfig network;
  LossConfig loss;
  ScheduleConfig schedule;
  AugmentationConfig augmentation;
  bool last_frame = false;     // of each sample only its last frame
  bool shuffle_pairs = false;  // control: every image gets the depth of another one
  std::uint64_t seed = 1;

  static DepthnetConfig read(ConfigReader& in);
};

}  // namespace tacipc
