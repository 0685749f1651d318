// Steps along gradients: AdamW.   [Loshchilov and Hutter 2019, algorithm 2]
#pragma once

#include <torch/script.h>

#include <string>
#include <vector>

#include "common/base/byte_reader.h"

namespace tacipc {

/// Changes weights in place. Its state, with the weights, can be kept as bytes: plain numbers, as an archive of
/// libtorch is a program.
class AdamW {
 public:
  AdamW(std::vector<torch::Tensor> weights, double weight_decay);

  /// θ ← (1 − η λ) θ − η m̂ / (√v̂ + ε), with m̂ and v̂ the running means of the gradient g and of g², each divided by
  /// 1 − βᵗ after t steps; η the rate, λ the decay. \pre a gradient for each weight
  void step(const std::vector<torch::Tensor>& gradients, double rate);

  void append_to(std::string& bytes) const;
  /// What append_to appended. \throw DataError if the bytes end before
  void read(ByteReader& bytes);

 private:
  std::vector<torch::Tensor> weights_, means_, squares_;
  double weight_decay_;
  std::int64_t steps_ = 0;
};

}  // namespace tacipc
