#include "stages/image/depthnet/outcome_network.h"

#include "stages/image/depthnet/script_writer.h"

namespace tacipc {
namespace {

/// Divisors of grey levels that bring the network's input to the order of one. Changes since the fingers closed are
/// smaller than those since they were open.
constexpr double kStepCodes = 16.0, kSinceCodes = 8.0;

}  // namespace

torch::jit::Module make_outcome_network(const OutcomeConfig& config, std::uint64_t seed) {
  torch::jit::Module module("OutcomeFromTouch");
  ScriptWriter writer(module, "logit", seed);
  writer.begin_sequences(config.frames, kStepCodes, kSinceCodes, 1 << config.network.levels);
  write_contracting_path(config.network, writer);
  const int images = 2 * config.frames;
  writer.pool_and_join(images);
  writer.convolution(images * 2 * channels_of(config.network, config.network.levels), config.hidden, 1, true);
  writer.convolution(config.hidden, 1, 1, false);
  writer.end_with_number();
  define_reduced(module, config.network.reduction);
  module.define(R"(
def forward(self, images, references):
    shape = [-1, images.size(3), images.size(4), 3]
    references = references.unsqueeze(2).expand_as(images)
    return torch.sigmoid(self.logit(self.reduced(images.reshape(shape), references.reshape(shape))[:, 0:3]))
)");
  return module;
}

}  // namespace tacipc
