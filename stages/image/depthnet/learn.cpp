#include "stages/image/depthnet/learn.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <torch/csrc/autograd/autograd.h>
#include <torch/optim/adamw.h>
#include <torch/serialize.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/rng.h"
#include "stages/image/depthnet/network.h"

namespace tacipc {
namespace {

constexpr std::uint64_t kOrderStream = 1;

struct ItemResult {
  std::vector<torch::Tensor> gradients;
  double loss = 0.0;
  std::vector<double> sums;
};

/// Rate at a step of the whole training: a linear rise, then half a cosine down to 0.
double rate_at(double epochs_done, const ScheduleConfig& schedule) {
  if (epochs_done < schedule.warmup_epochs) return schedule.learning_rate * epochs_done / schedule.warmup_epochs;
  const double fall = (epochs_done - schedule.warmup_epochs) / std::max(1e-9, schedule.epochs - schedule.warmup_epochs);
  return 0.5 * schedule.learning_rate * (1.0 + std::cos(std::numbers::pi * std::min(1.0, fall)));
}

std::string bytes_of(const std::vector<torch::Tensor>& weights, const torch::optim::Optimizer& optimizer,
                     const std::vector<LearntEpoch>& rows) {
  torch::serialize::OutputArchive archive, state;
  for (std::size_t i = 0; i < weights.size(); ++i) archive.write(fmt::format("weight_{}", i), weights[i].detach());
  optimizer.save(state);
  archive.write("optimizer", state);
  std::vector<double> numbers;
  for (const LearntEpoch& row : rows) {
    numbers.insert(numbers.end(), {row.learning_rate, row.loss});
    numbers.insert(numbers.end(), row.judged.begin(), row.judged.end());
  }
  archive.write("rows", torch::tensor(numbers, torch::kDouble).reshape({static_cast<std::int64_t>(rows.size()), -1}));
  std::ostringstream out;
  archive.save_to(out);
  return out.str();
}

std::vector<LearntEpoch> restore(const std::string& bytes, std::vector<torch::Tensor>& weights,
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
  std::vector<LearntEpoch> rows;
  for (std::int64_t r = 0; r < numbers.size(0); ++r) {
    const double* row = numbers.data_ptr<double>() + r * numbers.size(1);
    rows.push_back({.learning_rate = row[0], .loss = row[1], .judged = {row + 2, row + numbers.size(1)}});
  }
  return rows;
}

}  // namespace

std::vector<std::size_t> random_order(std::size_t count, std::uint64_t seed, std::uint64_t stream, int epoch) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return random_bits(seed, mix_bits(hash_of("order") + stream) + static_cast<std::uint64_t>(epoch), i);
  };
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return std::pair(key(a), a) < std::pair(key(b), b); });
  return order;
}

std::vector<std::string> history_fields(const std::vector<LearntEpoch>& history, const LearntEpoch& row) {
  std::vector<std::string> fields{std::to_string(&row - history.data() + 1), fmt::format("{}", row.learning_rate),
                                  fmt::format("{}", row.loss)};
  for (const double number : row.judged) fields.push_back(fmt::format("{}", number));
  return fields;
}

std::vector<LearntEpoch> learn(std::vector<torch::Tensor> weights, const Lesson& lesson, const ScheduleConfig& schedule,
                               std::uint64_t seed, const Checkpoints& checkpoints, const std::string& name) {
  const std::string who = name.empty() ? "" : name + ", ";
  torch::optim::AdamW optimizer(weights,
                                torch::optim::AdamWOptions(schedule.learning_rate).weight_decay(schedule.weight_decay));
  auto& options = static_cast<torch::optim::AdamWOptions&>(optimizer.param_groups().front().options());
  std::vector<LearntEpoch> rows;
  if (const auto saved = checkpoints.load()) {
    rows = restore(*saved, weights, optimizer);
    log_info("{}goes on after epoch {}", who, rows.size());
  }
  const auto batch = static_cast<std::size_t>(schedule.batch);
  auto saved_at = std::chrono::steady_clock::now();
  for (int epoch = static_cast<int>(rows.size()) + 1; epoch <= schedule.epochs; ++epoch) {
    const std::vector<std::size_t> order = random_order(lesson.examples, seed, kOrderStream, epoch);
    LearntEpoch row;
    std::vector<double> sums;
    for (std::size_t begin = 0; begin < order.size(); begin += batch) {
      const std::size_t count = std::min(batch, order.size() - begin);
      std::vector<ItemResult> results(count);
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        stay_in_this_thread();
        Lesson::Answer answer = lesson.answer(epoch, order[begin + k]);
        results[k] = {.gradients = torch::autograd::grad({answer.loss}, weights),
                      .loss = answer.loss.item<double>(),
                      .sums = std::move(answer.sums)};
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
        throw SolverError("{}epoch {}: the gradient is not finite; a smaller learning_rate may help", who, epoch);
      const double shorten = std::min(1.0, schedule.gradient_norm / std::max(1e-300, std::sqrt(squares)));
      for (std::size_t w = 0; w < weights.size(); ++w) weights[w].mutable_grad() = gradients[w] * shorten;
      const double done = epoch - 1 + static_cast<double>(begin + count) / static_cast<double>(order.size());
      row.learning_rate =
          rate_at(done - 0.5 * static_cast<double>(count) / static_cast<double>(order.size()), schedule);
      options.lr(row.learning_rate);
      optimizer.step();
      for (const ItemResult& result : results) {
        row.loss += result.loss / static_cast<double>(order.size());
        sums.resize(result.sums.size());
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += result.sums[i];
      }
      show_progress(done / schedule.epochs, fmt::format("{}epoch {} of {}, loss {:.4f}", who, epoch, schedule.epochs,
                                                        rows.empty() ? results.front().loss : rows.back().loss));
    }
    row.judged = lesson.judged(epoch, row.loss, sums);
    rows.push_back(std::move(row));
    const auto now = std::chrono::steady_clock::now();
    if (epoch == schedule.epochs ? checkpoints.at_end : now - saved_at >= checkpoints.between) {
      checkpoints.save(bytes_of(weights, optimizer, rows));
      saved_at = now;
    }
  }
  return rows;
}

}  // namespace tacipc
