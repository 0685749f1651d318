// Training of any network: gradients of single examples, in any number of threads, added in the order of the batch.
#pragma once

#include <torch/script.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "stages/image/depthnet/depthnet_config.h"

namespace tacipc {

/// What is to be learnt. Functions are called in any thread; their results depend on their arguments and the weights.
struct Lesson {
  struct Answer {
    torch::Tensor loss;
    std::vector<double> sums;  // added up over an epoch
  };
  std::size_t examples;
  /// Of an example as it is met in this epoch, the first one 1.
  std::function<Answer(int epoch, std::size_t index)> answer;
  /// After an epoch: further numbers of its row, always as many, of the mean loss and the sums of its examples.
  std::function<std::vector<double>(int epoch, double loss, const std::vector<double>& sums)> judged;
};

/// Where a training that was interrupted goes on.
struct Checkpoints {
  std::function<std::optional<std::string>()> load;
  std::function<void(const std::string&)> save;
  std::chrono::seconds between{20};  // at least, from one to the next
  bool at_end = false;               // one of the finished training, too: others follow in the same run
};

/// An epoch, the first one first.
struct LearntEpoch {
  double learning_rate = 0.0;  // of its last step
  double loss = 0.0;           // mean over the examples, as they were met
  std::vector<double> judged = {};
};

/// Trains the weights in place (AdamW, Loshchilov and Hutter 2019); the order of the examples is drawn by the seed.
/// Results depend on nothing but weights, lesson, schedule and seed. `name` stands before what is logged.
/// \pre there are examples
std::vector<LearntEpoch> learn(std::vector<torch::Tensor> weights, const Lesson& lesson, const ScheduleConfig& schedule,
                               std::uint64_t seed, const Checkpoints& checkpoints, const std::string& name = {});

/// Fields of an epoch in a history.csv: its number, rate, loss and what was judged.
std::vector<std::string> history_fields(const std::vector<LearntEpoch>& history, const LearntEpoch& row);

/// The numbers from 0 on, sorted by random numbers of seed, stream and epoch.
std::vector<std::size_t> random_order(std::size_t count, std::uint64_t seed, std::uint64_t stream, int epoch);

}  // namespace tacipc
