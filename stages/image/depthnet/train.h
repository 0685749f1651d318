// Trains the network that estimates depth.
#pragma once

#include <array>
#include <vector>

#include "stages/image/depthnet/augment.h"
#include "stages/image/depthnet/learn.h"
#include "stages/image/depthnet/network.h"

namespace tacipc {

/// Evaluated errors of an epoch: the mean over all pixels of the images as augmented, and over the pixels in contact;
/// then both for the validation, NaN without validation images.
inline constexpr std::array kJudgedErrors{"mae_mm", "mae_contact_mm", "validation_mae_mm", "validation_mae_contact_mm"};

/// Loss of the network for one example.
/// \throw DataError if no pixel has a depth
torch::Tensor loss_of(const torch::Tensor& predicted_mm, const torch::Tensor& depth_mm, const LossConfig& config);

/// Sums of errors over pixels, at the network's resolution.
struct ErrorSums {
  double pixels = 0.0, error_mm = 0.0;                  // sums over pixels with a depth
  double contact_pixels = 0.0, contact_error_mm = 0.0;  // sums over pixels deeper than kContactMm
  double mae_mm() const { return error_mm / pixels; }   // NaN without pixels
  double mae_contact_mm() const { return contact_error_mm / contact_pixels; }
};
/// Errors of the network over items.
/// \return zero sums without items
ErrorSums errors_of(const torch::jit::Module& network, const std::vector<DepthItem>& items);

/// Trains the weights in place. Results depend only on network, items and configuration.
/// \pre items are not empty
/// \return the epochs with kJudgedErrors, including those before an interruption
std::vector<LearntEpoch> train(torch::jit::Module& network, const std::vector<DepthItem>& items,
                               const std::vector<DepthItem>& validation, const DepthnetConfig& config,
                               const Checkpoints& checkpoints);

/// Gives each item the depth of another, by a random cycle.
/// \throw DataError unless there are at least two, all of one size
void shuffle_depths(std::vector<DepthItem>& items, std::uint64_t seed);

}  // namespace tacipc
