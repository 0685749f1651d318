// Network that predicts the outcome of a grasp, as a TorchScript module.
#pragma once

#include <torch/script.h>

#include "stages/image/depthnet/outcome_config.h"

namespace tacipc {

/// Makes the network. Each image, as its changes against the reference and against its finger's first image, goes
/// through the contracting path of the U-Net. Mean and maximum of the last maps' channels are concatenated over all
/// images of a grasp (left finger first, each in order of time). Two layers turn them into one number, whose logistic
/// function is the probability that the object is held. Methods, N grasps of K images per finger:
/// - `forward(images, references)`: u8 (N, 2, K, H, W, 3), (N, 2, H, W, 3) → probabilities, f32 (N)
/// - `reduced(image, reference)`: input of the network (define_reduced)
/// - `logit(x)`: the first three channels of that input, f32 (N × 2 K, 3, h, w) → f32 (N)
torch::jit::Module make_outcome_network(const OutcomeConfig& config, std::uint64_t seed);

}  // namespace tacipc
