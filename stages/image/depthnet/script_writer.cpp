#include "stages/image/depthnet/script_writer.h"

#include <fmt/core.h>

#include <cmath>

#include "common/base/rng.h"

namespace tacipc {

ScriptWriter::ScriptWriter(torch::jit::Module& module, const std::string& name, std::uint64_t seed)
    : module_(module), seed_(seed), source_("def " + name + "(self, x):\n") {}

void ScriptWriter::begin(double change_codes, double reference_codes, int multiple) {
  line("height = x.size(2)");
  line("width = x.size(3)");
  line(fmt::format("x = torch.cat([x[:, 0:3] * {}, x[:, 3:6] * {} - 1.0], 1)", 1.0 / change_codes,
                   1.0 / reference_codes));
  pad(multiple);
}

void ScriptWriter::begin_sequences(int images, double change_codes, double since_codes, int multiple) {
  line("height = x.size(2)");
  line("width = x.size(3)");
  line(fmt::format("x = x.reshape([-1, {}, 3, height, width])", images));
  line(fmt::format("x = torch.cat([x * {}, (x - x[:, 0:1]) * {}], 2).reshape([-1, 6, height, width])",
                   1.0 / change_codes, 1.0 / since_codes));
  pad(multiple);
}

void ScriptWriter::pad(int multiple) {
  line(fmt::format("x = torch.replication_pad2d(x, [0, ({0} - width % {0}) % {0}, 0, ({0} - height % {0}) % {0}])",
                   multiple));
}

void ScriptWriter::convolution(int in, int out, int width, bool rectified) {
  const std::string name = weight_name(count_);
  // After a rectifier a variance of 2 / fan-in keeps the signal's size. The last layer begins with outputs near 0.
  const double sigma = rectified ? std::sqrt(2.0 / (in * width * width)) : 0.1 * std::sqrt(1.0 / (in * width * width));
  torch::Tensor weight = torch::empty({out, in, width, width});
  float* values = weight.data_ptr<float>();
  for (std::int64_t i = 0; i < weight.numel(); ++i)
    values[i] = static_cast<float>(
        sigma * random_normal(seed_, static_cast<std::uint64_t>(count_), static_cast<std::uint64_t>(i)));
  module_.register_parameter(name, weight.requires_grad_(true), false);
  module_.register_parameter(bias_name(count_), torch::zeros({out}).requires_grad_(true), false);
  const std::string call =
      fmt::format("torch.conv2d(x, self.{}, self.{}, [1, 1], [{}, {}])", name, bias_name(count_), width / 2, width / 2);
  line(rectified ? fmt::format("x = torch.relu({})", call) : "x = " + call);
  ++count_;
}

void ScriptWriter::halve() { line("x = torch.max_pool2d(x, [2, 2])"); }

void ScriptWriter::keep(int level) { line(fmt::format("x{} = x", level)); }

void ScriptWriter::enlarge_and_join(int level) {
  line(fmt::format("x = torch.upsample_bilinear2d(x, [x{0}.size(2), x{0}.size(3)], False)", level));
  line(fmt::format("x = torch.cat([x{}, x], 1)", level));
}

void ScriptWriter::end() {
  line("return x[:, :, 0:height, 0:width]");
  module_.define(source_);
}

void ScriptWriter::pool_and_join(int images) {
  line("x = torch.cat([torch.mean(x, [2, 3]), torch.amax(x, [2, 3])], 1)");
  line(fmt::format("x = x.reshape([-1, {} * x.size(1), 1, 1])", images));
}

void ScriptWriter::end_with_number() {
  line("return x.reshape([-1])");
  module_.define(source_);
}

void define_reduced(torch::jit::Module& module, int reduction) {
  module.define(fmt::format(R"(
def reduced(self, image, reference):
    reference = reference.expand_as(image).to(6).permute([0, 3, 1, 2])
    change = image.to(6).permute([0, 3, 1, 2]) - reference
    return torch.avg_pool2d(torch.cat([change, reference], 1), [{0}, {0}], [{0}, {0}], [0, 0], True, False)
)",
                            reduction));
}

}  // namespace tacipc
