// Optimiser AdamW.   [Loshchilov and Hutter 2019, algorithm 2]
#pragma once

#include <torch/script.h>

#include <string>
#include <vector>

#include "common/base/byte_reader.h"

namespace tacipc {

/// Changes weights in place. Its state can be stored as bytes, with the weights. They are plain numbers, because an
/// archive of libtorch is a program.
class AdamW {
 public:
  AdamW(std::vector<torch::Tensor> weights, double weight_decay);

  /// Takes one step: θ ← (1 − η λ) θ − η m̂ / (√v̂ + ε), where m̂ and v̂ are the running means of the gradient g and of
  /// g², each divided by 1 − βᵗ after t steps, η is the rate and λ the decay.
  /// \pre a gradient for each weight
  void step(const std::vector<torch::Tensor>& gradients, double rate);

  void append_to(std::string& bytes) const;
  /// Restores the state from append_to.
  /// \throw DataError if the bytes end too early
  void read(ByteReader& bytes);

 private:
  std::vector<torch::Tensor> weights_, means_, squares_;
  double weight_decay_;
  std::int64_t steps_ = 0;
};

}  // namespace tacipc
