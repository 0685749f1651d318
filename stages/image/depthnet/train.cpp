#include "stages/image/depthnet/train.h"

#include <tbb/parallel_for.h>
#include <torch/csrc/autograd/autograd.h>
#include <torch/optim/adamw.h>
#include <torch/serialize.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <sstream>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/rng.h"

namespace tacipc {
namespace {

constexpr std::uint64_t kOrderStream = 1, kPairStream = 2;

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

/// Order of the items in an epoch: sorted by random numbers.
std::vector<std::size_t> order_of(std::size_t count, std::uint64_t seed, std::uint64_t stream, int epoch) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return random_bits(seed, mix_bits(hash_of("order") + stream) + static_cast<std::uint64_t>(epoch), i);
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  return order;
}

struct ItemResult {
  std::vector<torch::Tensor> gradients;
  double loss = 0.0;
  ErrorSums errors;
};

/// Rate at a step of the whole training: a linear rise, then half a cosine down to 0.
double rate_at(double epochs_done, const ScheduleConfig& schedule) {
  if (epochs_done < schedule.warmup_epochs) return schedule.learning_rate * epochs_done / schedule.warmup_epochs;
  const double fall = (epochs_done - schedule.warmup_epochs) / std::max(1e-9, schedule.epochs - schedule.warmup_epochs);
  return 0.5 * schedule.learning_rate * (1.0 + std::cos(std::numbers::pi * std::min(1.0, fall)));
}

constexpr std::int64_t kRowNumbers = 6;
static_assert(sizeof(EpochRow) == kRowNumbers * sizeof(double));  // a row of numbers

std::string bytes_of(const std::vector<torch::Tensor>& weights, const torch::optim::Optimizer& optimizer,
                     const std::vector<EpochRow>& rows) {
  torch::serialize::OutputArchive archive, state;
  for (std::size_t i = 0; i < weights.size(); ++i) archive.write(fmt::format("weight_{}", i), weights[i].detach());
  optimizer.save(state);
  archive.write("optimizer", state);
  torch::Tensor numbers = torch::empty({static_cast<std::int64_t>(rows.size()), kRowNumbers}, torch::kDouble);
  std::memcpy(numbers.data_ptr(), rows.data(), rows.size() * sizeof(EpochRow));
  archive.write("rows", numbers);
  std::ostringstream out;
  archive.save_to(out);
  return out.str();
}

std::vector<EpochRow> restore(const std::string& bytes, std::vector<torch::Tensor>& weights,
                              torch::optim::Optimizer& optimizer) {
  std::istringstream in(bytes);
  torch::serialize::InputArchive archive, state;
  archive.load_from(in);
  const torch::NoGradGuard no_gradients;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    torch::Tensor saved;
    archive.read(fmt::format("weight_{}", i), saved);
    weights[i].copy_(saved);
  }
  archive.read("optimizer", state);
  optimizer.load(state);
  torch::Tensor numbers;
  archive.read("rows", numbers);
  std::vector<EpochRow> rows(static_cast<std::size_t>(numbers.size(0)));
  std::memcpy(rows.data(), numbers.data_ptr(), rows.size() * sizeof(EpochRow));
  return rows;
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

void ErrorSums::add(const ErrorSums& other) {
  pixels += other.pixels;
  error_mm += other.error_mm;
  contact_pixels += other.contact_pixels;
  contact_error_mm += other.contact_error_mm;
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
  for (const ErrorSums& one : sums) all.add(one);
  return all;
}

std::vector<EpochRow> train(torch::jit::Module& network, const std::vector<DepthItem>& items,
                            const std::vector<DepthItem>& validation, const DepthnetConfig& config,
                            const Checkpoints& checkpoints) {
  const ScheduleConfig& schedule = config.schedule;
  std::vector<torch::Tensor> weights = weights_of(network);
  torch::optim::AdamW optimizer(weights,
                                torch::optim::AdamWOptions(schedule.learning_rate).weight_decay(schedule.weight_decay));
  auto& options = static_cast<torch::optim::AdamWOptions&>(optimizer.param_groups().front().options());
  std::vector<EpochRow> rows;
  if (const auto saved = checkpoints.load()) {
    rows = restore(*saved, weights, optimizer);
    log_info("goes on after epoch {}", rows.size());
  }
  const auto batch = static_cast<std::size_t>(schedule.batch);
  auto saved_at = std::chrono::steady_clock::now();
  for (int epoch = static_cast<int>(rows.size()) + 1; epoch <= schedule.epochs; ++epoch) {
    const std::vector<std::size_t> order = order_of(items.size(), config.seed, kOrderStream, epoch);
    EpochRow row;
    ErrorSums errors;
    for (std::size_t begin = 0; begin < order.size(); begin += batch) {
      const std::size_t count = std::min(batch, order.size() - begin);
      std::vector<ItemResult> results(count);
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        stay_in_this_thread();
        const std::size_t index = order[begin + k];
        const DepthExample example = augmented(items[index], config.augmentation, config.seed, epoch, index);
        const torch::Tensor depth_mm = predicted(network, example.input);
        const torch::Tensor loss = loss_of(depth_mm, example.depth_mm, config.loss);
        results[k].gradients = torch::autograd::grad({loss}, weights);
        results[k].loss = loss.item<double>();
        results[k].errors = errors_of(depth_mm.detach(), example.depth_mm);
      });
      const torch::NoGradGuard no_gradients;
      std::vector<torch::Tensor> gradients = std::move(results.front().gradients);
      for (std::size_t k = 1; k < count; ++k)
        for (std::size_t w = 0; w < weights.size(); ++w) gradients[w] += results[k].gradients[w];
      double squares = 0.0;
      for (torch::Tensor& gradient : gradients) {
        gradient /= static_cast<double>(count);
        squares += gradient.square().sum(torch::kDouble).item<double>();
      }
      if (!std::isfinite(squares))
        throw SolverError("epoch {}: the gradient is not finite; a smaller learning_rate may help", epoch);
      const double shorten = std::min(1.0, schedule.gradient_norm / std::max(1e-300, std::sqrt(squares)));
      for (std::size_t w = 0; w < weights.size(); ++w) weights[w].mutable_grad() = gradients[w] * shorten;
      const double done = epoch - 1 + static_cast<double>(begin + count) / static_cast<double>(order.size());
      row.learning_rate =
          rate_at(done - 0.5 * static_cast<double>(count) / static_cast<double>(order.size()), schedule);
      options.lr(row.learning_rate);
      optimizer.step();
      for (const ItemResult& result : results) {
        row.loss += result.loss / static_cast<double>(order.size());
        errors.add(result.errors);
      }
      show_progress(done / schedule.epochs, fmt::format("epoch {} of {}, loss {:.4f}", epoch, schedule.epochs,
                                                        rows.empty() ? results.front().loss : rows.back().loss));
    }
    const ErrorSums judged = errors_of(network, validation);
    row.mae_mm = errors.mae_mm();
    row.mae_contact_mm = errors.mae_contact_mm();
    row.validation_mae_mm = judged.mae_mm();
    row.validation_mae_contact_mm = judged.mae_contact_mm();
    rows.push_back(row);
    log_info("epoch {}: loss {:.5f}, in contact {:.4f} mm{}", epoch, row.loss, row.mae_contact_mm,
             validation.empty() ? "" : fmt::format(", of the validation {:.4f} mm", row.validation_mae_contact_mm));
    const auto now = std::chrono::steady_clock::now();
    if (now - saved_at >= checkpoints.between && epoch < schedule.epochs) {
      checkpoints.save(bytes_of(weights, optimizer, rows));
      saved_at = now;
    }
  }
  return rows;
}

void shuffle_depths(std::vector<DepthItem>& items, std::uint64_t seed) {
  if (items.size() < 2) throw DataError("shuffle_pairs: needs two images at least");
  for (const DepthItem& item : items)
    if (item.depth_mm.sizes() != items.front().depth_mm.sizes())
      throw DataError("shuffle_pairs: needs images of one size; {} and {} differ", item.name, items.front().name);
  const std::vector<std::size_t> cycle = order_of(items.size(), seed, kPairStream, 0);
  const torch::Tensor first = items[cycle.front()].depth_mm;
  for (std::size_t k = 0; k + 1 < cycle.size(); ++k) items[cycle[k]].depth_mm = items[cycle[k + 1]].depth_mm;
  items[cycle.back()].depth_mm = first;
}

}  // namespace tacipc
