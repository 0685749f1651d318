#include "stages/image/depthnet/network.h"

#include <ATen/Parallel.h>
#include <fmt/core.h>
#include <torch/csrc/jit/runtime/graph_executor.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.h"
#include "common/image/picture.h"
#include "stages/image/depthnet/script_writer.h"

// Small convolutions use BLAS, from whichever libblas.so.3 is installed.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace tacipc {

torch::jit::Module make_network(const NetworkConfig& config, std::uint64_t seed) {
  torch::jit::Module module("DepthFromTouch");
  ScriptWriter writer(module, "indentation", seed);
  write_unet(config, writer);
  define_reduced(module, config.reduction);
  module.define(fmt::format(R"(
def forward(self, image, reference):
    x = self.indentation(self.reduced(image, reference))
    x = torch.upsample_bilinear2d(x, [{0} * x.size(2), {0} * x.size(3)], False)
    return x[:, 0, 0:image.size(1), 0:image.size(2)]
)",
                            config.reduction));
  return module;
}

std::vector<torch::Tensor> weights_of(const torch::jit::Module& network) {
  std::vector<torch::Tensor> weights;
  for (const torch::Tensor& weight : network.parameters()) weights.push_back(weight);
  return weights;
}

std::int64_t count_weights(const torch::jit::Module& network) {
  std::int64_t count = 0;
  for (const torch::Tensor& weight : network.parameters()) count += weight.numel();
  return count;
}

std::vector<float> numbers_of(const torch::Tensor& tensor) {
  const torch::Tensor numbers = tensor.detach().contiguous();
  return {numbers.data_ptr<float>(), numbers.data_ptr<float>() + numbers.numel()};
}

torch::Tensor tensor_of(const ByteImage& image) {
  torch::Tensor tensor = torch::empty({1, image.height, image.width, 3}, torch::kU8);
  std::ranges::copy(image.pixels, tensor.data_ptr<std::uint8_t>());
  return tensor;
}

FloatImage TrainedNetwork::depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference) const {
  if (image.width != reference.width || image.height != reference.height)
    throw DataError("{}: has {} x {} pixels, its reference {} x {}", name, image.width, image.height, reference.width,
                    reference.height);
  if (std::ranges::find(sizes, ImageSize(image.height, image.width)) == sizes.end())
    throw DataError("{}: has {} x {} pixels; the network was trained on images of {} x {}", name, image.width,
                    image.height, sizes.front().second, sizes.front().first);
  const torch::NoGradGuard no_gradients;
  const torch::Tensor answer =
      module.get_method("forward")({tensor_of(image), tensor_of(reference)}).toTensor().to(torch::kFloat).contiguous();
  FloatImage out(image.width, image.height, 1);
  if (answer.numel() != static_cast<std::int64_t>(out.pixels.size()))
    throw DataError("{}: the network answers with {} numbers", name, answer.numel());
  std::copy_n(answer.data_ptr<float>(), out.pixels.size(), out.pixels.begin());
  if (!std::ranges::all_of(out.pixels, [](float depth) { return std::isfinite(depth); }))
    throw DataError("{}: is damaged: its depth of {} is not finite", file, name);
  return out;
}

DepthModel depth_model_of(const torch::jit::Module& module, const NetworkConfig& config, const ImageSize& size,
                          const TrainedLook* look) {
  DepthModel model{.network = config, .rows = size.first, .columns = size.second, .convolutions = {}, .look = {}};
  if (look) model.look = *look;
  const std::vector<torch::Tensor> weights = weights_of(module);
  for (std::size_t k = 0; k < weights.size(); k += 2)
    model.convolutions.push_back({.weights = numbers_of(weights[k]), .biases = numbers_of(weights[k + 1])});
  return model;
}

TrainedNetwork load_network(const std::vector<std::filesystem::path>& files) {
  TrainedNetwork network{.file = files.front().string(), .module = torch::jit::Module(), .sizes = {}};
  DepthModel first;
  for (const std::filesystem::path& file : files) {
    DepthModel model = read_depth_model(file);
    const ImageSize size(model.rows, model.columns);
    network.sizes.push_back(size);
    if (model.look) network.looks.insert_or_assign(size, *model.look);
    if (file == files.front())
      first = std::move(model);
    else if (model.network != first.network || model.convolutions != first.convolutions)
      throw DataError("{}: is another network than {}", file.string(), files.front().string());
  }
  network.module = make_network(first.network, 0);
  std::vector<torch::Tensor> weights = weights_of(network.module);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    weights[k].set_requires_grad(false);  // otherwise every evaluation would prepare for gradients
    const Convolution& convolution = first.convolutions[k / 2];
    std::ranges::copy(k % 2 == 0 ? convolution.weights : convolution.biases, weights[k].data_ptr<float>());
  }
  return network;
}

void save_script(const torch::jit::Module& module, const std::filesystem::path& file) {
  for (torch::Tensor& weight : weights_of(module)) weight.set_requires_grad(false);  // as in load_network
  module.save(file.string());
}

std::optional<LookComparison> compare(const TrainedNetwork& network, const ByteImage& image,
                                      const ByteImage& reference) {
  const auto found = network.looks.find({image.height, image.width});
  if (found == network.looks.end()) return std::nullopt;
  const int reduction = found->second.reduction();
  return found->second.compare(means_over_squares(reference, reduction), means_over_squares(image, reduction));
}

void stay_in_this_thread() {
  // Optimised executors record and recompile the code they run, which makes a few calls slower and results vary.
  torch::jit::setGraphExecutorOptimize(false);
  at::set_num_threads(1);
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

}  // namespace tacipc
