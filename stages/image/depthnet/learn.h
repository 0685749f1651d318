// Trains any network: gradients of single examples, in any number of threads, summed in the order of the batch.
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

/// Task of a training. Its functions are called in any thread; their results depend only on their arguments and the
/// weights.
struct Lesson {
  struct Answer {
    torch::Tensor loss;
    std::vector<double> sums;  // numbers that are summed over an epoch
  };
  std::size_t examples;
  /// Loss of an example in this epoch; the first epoch is 1.
  std::function<Answer(int epoch, std::size_t index)> answer;
  /// Further numbers for the row of an epoch, always the same count, from the mean loss and the sums of its examples.
  std::function<std::vector<double>(int epoch, double loss, const std::vector<double>& sums)> judged;
};

/// Storage of states from which an interrupted training continues.
struct Checkpoints {
  std::function<std::optional<std::string>()> load;
  std::function<void(const std::string&)> save;
  std::chrono::seconds between{20};  // least time between two checkpoints
  bool at_end = false;               // also store the finished training, because others follow in the same run
};

/// One epoch, counted from 1 in the order of the history.
struct LearntEpoch {
  double learning_rate = 0.0;  // learning rate of its last step
  double loss = 0.0;           // mean over the examples as augmented
  std::vector<double> judged = {};
};

/// Trains the weights in place (AdamW, Loshchilov and Hutter 2019). The seed determines the order of the examples.
/// Results depend only on weights, lesson, schedule and seed.
/// \param name text before each log message
/// \pre there are examples
std::vector<LearntEpoch> learn(std::vector<torch::Tensor> weights, const Lesson& lesson, const ScheduleConfig& schedule,
                               std::uint64_t seed, const Checkpoints& checkpoints, const std::string& name = {});

/// Fields of an epoch in a history.csv: its number, rate, loss and evaluated numbers.
std::vector<std::string> history_fields(const std::vector<LearntEpoch>& history, const LearntEpoch& row);

/// The numbers 0 … count − 1, sorted by random numbers of seed, stream and epoch.
std::vector<std::size_t> random_order(std::size_t count, std::uint64_t seed, std::uint64_t stream, int epoch);

}  // namespace tacipc
