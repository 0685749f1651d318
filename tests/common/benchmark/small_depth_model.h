// A network so small that its answers are known by hand.
#pragma once

#include <string>

#include "common/benchmark/depth_model.h"

namespace tacipc {

/// Indentation in mm: 0.01 red − 0.02 green + 0.03 blue of the change in codes, + 0.5. One level with one channel,
/// which holds that, kept above zero by an offset of 8; the maps of the last level are zero.
inline DepthModel small_depth_model(int width, int height) {
  constexpr float kOffset = 8.0F, kChangeCodes = 32.0F;
  constexpr std::size_t kTaps = 9, kCentre = 4;
  DepthModel model{.network = {.levels = 1, .base_channels = 1, .reduction = 1},
                   .rows = height,
                   .columns = width,
                   .convolutions = {},
                   .look = {}};
  const auto add = [&](std::size_t in, std::size_t out, std::size_t taps) -> Convolution& {
    model.convolutions.push_back({.weights = std::vector<float>(in * out * taps), .biases = std::vector<float>(out)});
    return model.convolutions.back();
  };
  Convolution& first = add(6, 1, kTaps);
  const float factors[] = {0.01F, -0.02F, 0.03F};
  for (std::size_t c = 0; c < 3; ++c) first.weights[kTaps * c + kCentre] = factors[c] * kChangeCodes;
  first.biases[0] = 0.5F + kOffset;
  add(1, 1, kTaps).weights[kCentre] = 1.0F;
  add(1, 2, kTaps);
  add(2, 2, kTaps);
  add(3, 1, kTaps).weights[kCentre] = 1.0F;
  add(1, 1, kTaps).weights[kCentre] = 1.0F;
  Convolution& last = add(1, 1, 1);
  last.weights[0] = 1.0F;
  last.biases[0] = -kOffset;
  return model;
}

}  // namespace tacipc
