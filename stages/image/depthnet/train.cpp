#include "stages/image/depthnet/train.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include "common/base/error.h"
#include "common/base/log.h"

namespace tacipc {
namespace {

constexpr std::uint64_t kPairStream = 2;

ErrorSums errors_of(const torch::Tensor& predicted_mm, const torch::Tensor& depth_mm) {
  const torch::Tensor known = depth_mm.isfinite(), contact = depth_mm > kContactMm;
  const torch::Tensor error_mm = torch::where(known, (predicted_mm - depth_mm).abs(), torch::zeros({}));
  const auto sum = [](const torch::Tensor& values) { return values.sum(torch::kDouble).item<double>(); };
  return {.pixels = sum(known),
          .error_mm = sum(error_mm),
          .contact_pixels = sum(contact),
          .contact_error_mm = sum(error_mm * contact)};
}

torch::Tensor predicted(const torch::jit::Module& network, const torch::Tensor& input) {
  return network.get_method("indentation")({input}).toTensor();
}

}  // namespace

torch::Tensor loss_of(const torch::Tensor& predicted_mm, const torch::Tensor& depth_mm, const LossConfig& config) {
  const torch::Tensor valid = depth_mm.isfinite();
  const torch::Tensor weight = valid * (1.0 + config.contact_weight * (depth_mm > kContactMm));
  if (weight.sum().item<float>() <= 0.0F) throw DataError("no pixel has a depth");
  const torch::Tensor error = torch::where(valid, predicted_mm - depth_mm, torch::zeros({}));
  torch::Tensor loss = (weight * (config.squared ? error * error : error.abs())).sum() / weight.sum();
  if (config.slope_weight > 0.0)
    loss = loss + config.slope_weight * (error.diff(1, 2).abs().mean() + error.diff(1, 3).abs().mean());
  return loss;
}

ErrorSums errors_of(const torch::jit::Module& network, const std::vector<DepthItem>& items) {
  std::vector<ErrorSums> sums(items.size());
  tbb::parallel_for(std::size_t{0}, items.size(), [&](std::size_t i) {
    stay_in_this_thread();
    const torch::NoGradGuard no_gradients;
    const DepthExample example = example_of(items[i]);
    sums[i] = errors_of(predicted(network, example.input), example.depth_mm);
  });
  ErrorSums all;
  for (const ErrorSums& one : sums) {
    all.pixels += one.pixels;
    all.error_mm += one.error_mm;
    all.contact_pixels += one.contact_pixels;
    all.contact_error_mm += one.contact_error_mm;
  }
  return all;
}

std::vector<LearntEpoch> train(torch::jit::Module& network, const std::vector<DepthItem>& items,
                               const std::vector<DepthItem>& validation, const DepthnetConfig& config,
                               const Checkpoints& checkpoints) {
  const auto answer = [&](int epoch, std::size_t index) -> Lesson::Answer {
    const DepthExample example = augmented(items[index], config.augmentation, config.seed, epoch, index);
    const torch::Tensor depth_mm = predicted(network, example.input);
    const ErrorSums errors = errors_of(depth_mm.detach(), example.depth_mm);
    return {.loss = loss_of(depth_mm, example.depth_mm, config.loss),
            .sums = {errors.pixels, errors.error_mm, errors.contact_pixels, errors.contact_error_mm}};
  };
  const auto judged = [&](int epoch, double loss, const std::vector<double>& sums) -> std::vector<double> {
    const ErrorSums errors{
        .pixels = sums[0], .error_mm = sums[1], .contact_pixels = sums[2], .contact_error_mm = sums[3]};
    const ErrorSums validated = errors_of(network, validation);
    log_info("epoch {}: loss {:.5f}, in contact {:.4f} mm{}", epoch, loss, errors.mae_contact_mm(),
             validation.empty() ? "" : fmt::format(", of the validation {:.4f} mm", validated.mae_contact_mm()));
    return {errors.mae_mm(), errors.mae_contact_mm(), validated.mae_mm(), validated.mae_contact_mm()};
  };
  return learn(weights_of(network), {items.size(), answer, judged}, config.schedule, config.seed, checkpoints);
}

void shuffle_depths(std::vector<DepthItem>& items, std::uint64_t seed) {
  if (items.size() < 2) throw DataError("shuffle_pairs: needs two images at least");
  for (const DepthItem& item : items)
    if (item.depth_mm.sizes() != items.front().depth_mm.sizes())
      throw DataError("shuffle_pairs: needs images of one size; {} and {} differ", item.name, items.front().name);
  const std::vector<std::size_t> cycle = random_order(items.size(), seed, kPairStream, 0);
  const torch::Tensor first = items[cycle.front()].depth_mm;
  for (std::size_t k = 0; k + 1 < cycle.size(); ++k) items[cycle[k]].depth_mm = items[cycle[k + 1]].depth_mm;
  items[cycle.back()].depth_mm = first;
}

}  // namespace tacipc
