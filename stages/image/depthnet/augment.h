// What a network meets in training: an image as it might look in another sensor of the kind.
#pragma once

#include <cstdint>

#include "stages/image/depthnet/depthnet_config.h"
#include "stages/image/depthnet/training_set.h"

namespace tacipc {

struct DepthExample {
  torch::Tensor input;     // f32 (1, 6, h, w), as `reduced` of the network
  torch::Tensor depth_mm;  // f32 (1, 1, h, w)
};

/// Images of one sensor as they might look in another one of the kind.
struct SensorExample {
  torch::Tensor input;  // f32 (N, 6, h, w), as `reduced` of a network; (N, 3, h, w) without a reference
  int dx = 0, dy = 0;   // its shift, pixels of the network
};

/// With changes c (N, 3, h, w) and their reference r (3, h, w): c ← (1 + g) c + b + noise, r ← r + e, all shifted by
/// whole pixels, their border repeated; noise differs between the images. The reference may be undefined. Draws depend
/// on seed, epoch and index alone.
SensorExample disturbed(const torch::Tensor& change, const torch::Tensor& reference, const AugmentationConfig& config,
                        std::uint64_t seed, int epoch, std::size_t index);

/// The item as it is.
DepthExample example_of(const DepthItem& item);

/// Disturbed, and the depth shifted with it.
DepthExample augmented(const DepthItem& item, const AugmentationConfig& config, std::uint64_t seed, int epoch,
                       std::size_t index);

}  // namespace tacipc
