// Trains FOTS' network on photographs of balls [Zhao2024].
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "common/rival/light_network.h"
#include "stages/image/calibrate/contact_pixels.h"
#include "stages/image/calibrate/rival_config.h"

namespace tacipc {

/// Samples of the training, one column each.
struct NetworkSamples {
  Eigen::MatrixXf inputs;   // 5 rows
  Eigen::MatrixXf targets;  // 3 rows, change over 255
};

/// Samples at the pixels that are slanted and clipped in no channel.
NetworkSamples network_samples(const std::vector<std::vector<ContactPixel>>& balls, int width_px, int height_px);

/// Initial network: weights and biases uniform in ±1/√(inputs of the layer).
LightNetwork initial_network(std::uint64_t seed);

/// Factors on the hidden values: 0 or 1 / (1 − dropout). Empty: no dropout.
using DropoutMasks = std::array<Eigen::MatrixXf, LightNetwork::kLayers - 1>;

/// Mean squared error over samples and channels. Writes its gradient in the form of a network.
double loss_and_gradient(const LightNetwork& network, const NetworkSamples& samples, const DropoutMasks& masks,
                         LightNetwork& gradient);

/// Trains with Adam (0.9, 0.999, 1e-8) on batches, shuffled every epoch, in one thread: a seed always gives equal
/// bytes.
/// \throw DataError if there are no samples
LightNetwork train_network(const NetworkSamples& samples, const NetworkFit& settings);

}  // namespace tacipc
