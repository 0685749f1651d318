#include "stages/image/depthnet/network.h"

#include <ATen/Parallel.h>
#include <fmt/core.h>
#include <torch/csrc/jit/runtime/graph_executor.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "stages/image/depthnet/unet.h"

// Small convolutions go through BLAS, whichever libblas.so.3 is.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace tacipc {
namespace {

/// Writes the network's source and makes the weights it names.
class Builder : public NetworkWriter {
 public:
  Builder(torch::jit::Module& module, std::uint64_t seed) : module_(module), seed_(seed) {}

  void begin(double change_codes, double reference_codes, int multiple) override {
    line("height = x.size(2)");
    line("width = x.size(3)");
    line(fmt::format("x = torch.cat([x[:, 0:3] * {}, x[:, 3:6] * {} - 1.0], 1)", 1.0 / change_codes,
                     1.0 / reference_codes));
    line(fmt::format("x = torch.replication_pad2d(x, [0, ({0} - width % {0}) % {0}, 0, ({0} - height % {0}) % {0}])",
                     multiple));
  }
  void convolution(int in, int out, int width, bool rectified) override {
    const std::string name = weight_name(count_);
    // After a rectifier a variance of 2 / fan-in keeps the signal's size. The last layer begins near no indentation.
    const double sigma =
        rectified ? std::sqrt(2.0 / (in * width * width)) : 0.1 * std::sqrt(1.0 / (in * width * width));
    torch::Tensor weight = torch::empty({out, in, width, width});
    float* values = weight.data_ptr<float>();
    for (std::int64_t i = 0; i < weight.numel(); ++i)
      values[i] = static_cast<float>(
          sigma * random_normal(seed_, static_cast<std::uint64_t>(count_), static_cast<std::uint64_t>(i)));
    module_.register_parameter(name, weight.requires_grad_(true), false);
    module_.register_parameter(bias_name(count_), torch::zeros({out}).requires_grad_(true), false);
    const std::string call = fmt::format("torch.conv2d(x, self.{}, self.{}, [1, 1], [{}, {}])", name, bias_name(count_),
                                         width / 2, width / 2);
    line(rectified ? fmt::format("x = torch.relu({})", call) : "x = " + call);
    ++count_;
  }
  void halve() override { line("x = torch.max_pool2d(x, [2, 2])"); }
  void keep(int level) override { line(fmt::format("x{} = x", level)); }
  void enlarge_and_join(int level) override {
    line(fmt::format("x = torch.upsample_bilinear2d(x, [x{0}.size(2), x{0}.size(3)], False)", level));
    line(fmt::format("x = torch.cat([x{}, x], 1)", level));
  }
  void end() override {
    line("return x[:, :, 0:height, 0:width]");
    module_.define(source_);
  }

 private:
  void line(const std::string& text) { source_ += "    " + text + "\n"; }

  torch::jit::Module& module_;
  std::uint64_t seed_;
  int count_ = 0;
  std::string source_ = "def indentation(self, x):\n";
};

}  // namespace

torch::jit::Module make_network(const NetworkConfig& config, std::uint64_t seed) {
  torch::jit::Module module("DepthFromTouch");
  Builder builder(module, seed);
  write_unet(config, builder);
  module.define(fmt::format(R"(
def reduced(self, image, reference):
    reference = reference.expand_as(image).to(6).permute([0, 3, 1, 2])
    change = image.to(6).permute([0, 3, 1, 2]) - reference
    return torch.avg_pool2d(torch.cat([change, reference], 1), [{0}, {0}], [{0}, {0}], [0, 0], True, False)
)",
                            config.reduction));
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

torch::Tensor tensor_of(const ByteImage& image) {
  torch::Tensor tensor = torch::empty({1, image.height, image.width, 3}, torch::kU8);
  std::copy(image.pixels.begin(), image.pixels.end(), tensor.data_ptr<std::uint8_t>());
  return tensor;
}

FloatImage TrainedNetwork::depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference) const {
  if (image.width != reference.width || image.height != reference.height)
    throw DataError("{}: has {} x {} pixels, its reference {} x {}", name, image.width, image.height, reference.width,
                    reference.height);
  if (std::find(sizes.begin(), sizes.end(), ImageSize(image.height, image.width)) == sizes.end())
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
constexpr const char* kSizes = "image_sizes";  // a file in the archive: a line of rows and columns per size
}

void save_network(const TrainedNetwork& network, const std::filesystem::path& file) {
  // Users take no gradients; without this every answer would be ready for them.
  for (torch::Tensor& weight : weights_of(network.module)) weight.set_requires_grad(false);
  std::string sizes;
  for (const auto& [rows, columns] : network.sizes) sizes += fmt::format("{} {}\n", rows, columns);
  network.module.save(file.string(), {{kSizes, sizes}});
}

TrainedNetwork load_network(const std::filesystem::path& file) {
  TrainedNetwork network;
  torch::jit::ExtraFilesMap extra{{kSizes, ""}};
  try {
    network.module = torch::jit::load(file.string(), torch::kCPU, extra);
  } catch (const std::exception&) {
    throw DataError("{}: is not a network that depthnet wrote", file.string());
  }
  std::istringstream sizes(extra[kSizes]);
  for (ImageSize size; sizes >> size.first >> size.second;) network.sizes.push_back(size);
  if (network.sizes.empty() || !network.module.find_method("forward"))
    throw DataError("{}: is not a network that depthnet wrote", file.string());
  return network;
}

void stay_in_this_thread() {
  // Optimised executors record and recompile what they run: slower for a few calls, and not the same each time.
  torch::jit::setGraphExecutorOptimize(false);
  at::set_num_threads(1);
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

}  // namespace tacipc
