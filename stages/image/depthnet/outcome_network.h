// The network that foretells what becomes of a grasp, as a TorchScript module.
#pragma once

#include <torch/script.h>

#include "stages/image/depthnet/outcome_config.h"

namespace tacipc {

/// Each image, as its changes against the reference and against the first of its finger's, goes through the contracting
/// path of the U-Net; mean and maximum of its last maps' channels, of all
/// images of a grasp behind each other (left finger first, each in order of time), go through two layers to one
/// number, whose logistic function is the probability that the object is held. Methods, N grasps of K images a finger:
/// - `forward(images, references)`: u8 (N, 2, K, H, W, 3), (N, 2, H, W, 3) → probabilities, f32 (N)
/// - `reduced(image, reference)`: what the network sees (define_reduced)
/// - `logit(x)`: the first three channels of that, f32 (N × 2 K, 3, h, w) → f32 (N)
torch::jit::Module make_outcome_network(const OutcomeConfig& config, std::uint64_t seed);

}  // namespace tacipc
