// Augmentation: varies an image as it might look in another sensor of the same type.
#pragma once

#include <cstdint>

#include "stages/image/depthnet/depthnet_config.h"
#include "stages/image/depthnet/training_set.h"

namespace tacipc {

/// Input and target of one training example.
struct DepthExample {
  torch::Tensor input;     // f32 (1, 6, h, w), as from `reduced` of the network
  torch::Tensor depth_mm;  // f32 (1, 1, h, w)
};

/// Images of one sensor, varied as they might look in another sensor of the same type.
struct SensorExample {
  torch::Tensor input;  // f32 (N, 6, h, w), as from `reduced` of a network; (N, 3, h, w) without a reference
  int dx = 0, dy = 0;   // shift, pixels of the network
};

/// Disturbs changes c (N, 3, h, w) and their reference r (3, h, w): c ← (1 + g) c + b + noise, r ← r + e, all shifted
/// by whole pixels with repeated border. Noise differs between the images. The reference may be undefined. Draws depend
/// only on seed, epoch and index.
SensorExample disturbed(const torch::Tensor& change, const torch::Tensor& reference, const AugmentationConfig& config,
                        std::uint64_t seed, int epoch, std::size_t index);

/// Example of the unchanged item.
DepthExample example_of(const DepthItem& item);

/// Example of the disturbed item, with its depth shifted by the same pixels.
DepthExample augmented(const DepthItem& item, const AugmentationConfig& config, std::uint64_t seed, int epoch,
                       std::size_t index);

}  // namespace tacipc
