#include "stages/image/depthnet/network.h"

#include <ATen/Parallel.h>
#include <fmt/core.h>
#include <torch/csrc/jit/runtime/graph_executor.h>

#include <algorithm>
#include <sstream>

#include "common/base/error.h"
#include "common/image/picture.h"
#include "stages/image/depthnet/script_writer.h"

// Small convolutions go through BLAS, whichever libblas.so.3 is.
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
  return out;
}

namespace {
// Files in the archive: a line of rows and columns per size; for each size that and the length of a text, the text.
constexpr const char *kSizes = "image_sizes", *kLooks = "trained_looks";

std::string text_of(const std::map<ImageSize, TrainedLook>& looks) {
  std::string all;
  for (const auto& [size, look] : looks) {
    const std::string text = look.to_text();
    all += fmt::format("{} {} {}\n{}", size.first, size.second, text.size(), text);
  }
  return all;
}

std::map<ImageSize, TrainedLook> looks_in(const std::string& all, const std::string& name) {
  std::map<ImageSize, TrainedLook> looks;
  std::istringstream in(all);
  ImageSize size;
  std::size_t length = 0;
  while (in >> size.first >> size.second >> length) {
    in.get();  // the end of the line
    std::string text(std::min(length, all.size()), '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    looks.insert_or_assign(size, TrainedLook::from_text(text, name));
  }
  return looks;
}
}  // namespace

void save_network(const TrainedNetwork& network, const std::filesystem::path& file) {
  // Users take no gradients; without this every answer would be ready for them.
  for (torch::Tensor& weight : weights_of(network.module)) weight.set_requires_grad(false);
  std::string sizes;
  for (const auto& [rows, columns] : network.sizes) sizes += fmt::format("{} {}\n", rows, columns);
  network.module.save(file.string(), {{kSizes, sizes}, {kLooks, text_of(network.looks)}});
}

TrainedNetwork load_network(const std::filesystem::path& file) {
  TrainedNetwork network;
  torch::jit::ExtraFilesMap extra{{kSizes, ""}, {kLooks, ""}};
  try {
    network.module = torch::jit::load(file.string(), torch::kCPU, extra);
  } catch (const std::exception&) {
    throw DataError("{}: is not a network that depthnet wrote", file.string());
  }
  std::istringstream sizes(extra[kSizes]);
  for (ImageSize size; sizes >> size.first >> size.second;) network.sizes.push_back(size);
  if (network.module.find_method("logit"))
    throw DataError("{}: foretells outcomes of grasps, and reads no depth", file.string());
  if (network.sizes.empty() || !network.module.find_method("forward"))
    throw DataError("{}: is not a network that depthnet wrote", file.string());
  network.looks = looks_in(extra[kLooks], file.string());
  return network;
}

std::optional<LookComparison> compare(const TrainedNetwork& network, const ByteImage& image,
                                      const ByteImage& reference) {
  const auto found = network.looks.find({image.height, image.width});
  if (found == network.looks.end()) return std::nullopt;
  const int reduction = found->second.reduction();
  return found->second.compare(means_over_squares(reference, reduction), means_over_squares(image, reduction));
}

void stay_in_this_thread() {
  // Optimised executors record and recompile what they run: slower for a few calls, and not the same each time.
  torch::jit::setGraphExecutorOptimize(false);
  at::set_num_threads(1);
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

}  // namespace tacipc
