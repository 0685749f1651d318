#include "stages/image/depthnet/learn.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <torch/csrc/autograd/autograd.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/rng.h"
#include "stages/image/depthnet/adamw.h"
#include "stages/image/depthnet/network.h"

namespace tacipc {
namespace {

constexpr std::uint64_t kOrderStream = 1;

struct ItemResult {
  std::vector<torch::Tensor> gradients;
  double loss = 0.0;
  std::vector<double> sums;
};

/// Learning rate at a step of the whole training: a linear rise, then half a cosine down to 0.
double rate_at(double epochs_done, const ScheduleConfig& schedule) {
  if (epochs_done < schedule.warmup_epochs) return schedule.learning_rate * epochs_done / schedule.warmup_epochs;
  const double fall = (epochs_done - schedule.warmup_epochs) / std::max(1e-9, schedule.epochs - schedule.warmup_epochs);
  return 0.5 * schedule.learning_rate * (1.0 + std::cos(std::numbers::pi * std::min(1.0, fall)));
}

std::string bytes_of(const AdamW& optimizer, const std::vector<LearntEpoch>& rows) {
  std::string bytes;
  const auto add = [&](auto number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof(number)); };
  add(rows.size());
  add(rows.front().judged.size());
  for (const LearntEpoch& row : rows) {
    add(row.learning_rate);
    add(row.loss);
    for (const double number : row.judged) add(number);
  }
  optimizer.append_to(bytes);
  return bytes;
}

std::vector<LearntEpoch> restore(const std::string& bytes, AdamW& optimizer) {
  ByteReader in(bytes, "checkpoint");
  const auto epochs = in.read<std::size_t>("the number of epochs"), judged = in.read<std::size_t>("their numbers");
  std::vector<LearntEpoch> rows;
  for (std::size_t r = 0; r < epochs; ++r) {
    LearntEpoch row{.learning_rate = in.read<double>("a rate"), .loss = in.read<double>("a loss"), .judged = {}};
    for (std::size_t k = 0; k < judged; ++k) row.judged.push_back(in.read<double>("an epoch"));
    rows.push_back(std::move(row));
  }
  optimizer.read(in);
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
  AdamW optimizer(weights, schedule.weight_decay);
  std::vector<LearntEpoch> rows;
  if (const auto saved = checkpoints.load()) {
    rows = restore(*saved, optimizer);
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
      for (torch::Tensor& gradient : gradients) gradient = gradient * shorten;
      const double done = epoch - 1 + static_cast<double>(begin + count) / static_cast<double>(order.size());
      row.learning_rate =
          rate_at(done - 0.5 * static_cast<double>(count) / static_cast<double>(order.size()), schedule);
      optimizer.step(gradients, row.learning_rate);
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
      checkpoints.save(bytes_of(optimizer, rows));
      saved_at = now;
    }
  }
  return rows;
}

}  // namespace tacipc
