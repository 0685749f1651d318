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

/// The item as it is.
DepthExample example_of(const DepthItem& item);

/// With change c, reference r and depth d: c ← (1 + g) c + b + noise, r ← r + e, all three shifted by whole pixels,
/// their border repeated. Draws depend on seed, epoch and item alone.
DepthExample augmented(const DepthItem& item, const AugmentationConfig& config, std::uint64_t seed, int epoch,
                       std::size_t index);

}  // namespace tacipc
