#include "stages/image/depthnet/adamw.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace tacipc {
namespace {

constexpr double kBeta1 = 0.9, kBeta2 = 0.999, kEpsilon = 1e-8;

}  // namespace

AdamW::AdamW(std::vector<torch::Tensor> weights, double weight_decay)
    : weights_(std::move(weights)), weight_decay_(weight_decay) {
  for (const torch::Tensor& weight : weights_) {
    means_.push_back(torch::zeros_like(weight));
    squares_.push_back(torch::zeros_like(weight));
  }
}

void AdamW::step(const std::vector<torch::Tensor>& gradients, double rate) {
  assert(gradients.size() == weights_.size());
  const torch::NoGradGuard no_gradients;
  ++steps_;
  const double whole1 = 1.0 - std::pow(kBeta1, steps_), whole2 = 1.0 - std::pow(kBeta2, steps_);
  for (std::size_t w = 0; w < weights_.size(); ++w) {
    const torch::Tensor& gradient = gradients[w];
    weights_[w].mul_(1.0 - rate * weight_decay_);
    means_[w].mul_(kBeta1).add_(gradient, 1.0 - kBeta1);
    squares_[w].mul_(kBeta2).addcmul_(gradient, gradient, 1.0 - kBeta2);
    weights_[w].addcdiv_(means_[w], (squares_[w].sqrt() / std::sqrt(whole2)).add_(kEpsilon), -rate / whole1);
  }
}

void AdamW::append_to(std::string& bytes) const {
  bytes.append(reinterpret_cast<const char*>(&steps_), sizeof(steps_));
  for (const auto* tensors : {&weights_, &means_, &squares_})
    for (const torch::Tensor& tensor : *tensors)
      bytes.append(static_cast<const char*>(tensor.data_ptr()),
                   static_cast<std::size_t>(tensor.numel()) * sizeof(float));
}

void AdamW::read(ByteReader& bytes) {
  steps_ = bytes.read<std::int64_t>("the number of steps");
  for (const auto* tensors : {&weights_, &means_, &squares_})
    for (const torch::Tensor& tensor : *tensors)
      for (std::int64_t i = 0; i < tensor.numel(); ++i) tensor.data_ptr<float>()[i] = bytes.read<float>("the weights");
}

}  // namespace tacipc
