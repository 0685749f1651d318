#include "stages/image/depthnet/train.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <torch/csrc/autograd/autograd.h>

#include <chrono>
#include <cmath>

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/stages/image/depthnet/dents.h"

namespace tacipc {
namespace train_test {

const Checkpoints kNoCheckpoints{.load = [] { return std::optional<std::string>(); },
                                 .save = [](const std::string&) {}};

std::vector<float> numbers_of(const torch::jit::Module& network) {
  std::vector<float> numbers;
  for (const torch::Tensor& weight : weights_of(network))
    numbers.insert(numbers.end(), weight.data_ptr<float>(), weight.data_ptr<float>() + weight.numel());
  return numbers;
}

TEST(Loss, IsTheWeightedMeanErrorWithItsSlopes) {
  const float nan = std::nanf("");
  const torch::Tensor truth = torch::tensor({0.0F, 0.5F, nan}).expand({1, 1, 2, 3});
  const torch::Tensor said = torch::tensor({0.1F, 0.8F, 9.0F}).repeat({1, 1, 2, 1}).requires_grad_(true);
  EXPECT_NEAR(loss_of(said, truth, {.contact_weight = 2.0}).item<double>(), (0.1 + 3 * 0.3) / 4, 1e-6);
  EXPECT_NEAR(loss_of(said, truth, {.squared = true}).item<double>(), (0.01 + 0.09) / 2, 1e-6);
  // Errors 0.1 and 0.3, and none beside the gel, in both rows: slopes of 0.2 and -0.3.
  const torch::Tensor loss = loss_of(said, truth, {.slope_weight = 1.0});
  EXPECT_NEAR(loss.item<double>(), 0.2 + 0.25, 1e-6);
  EXPECT_EQ(torch::autograd::grad({loss}, {said})[0][0][0][0][2].item<float>(), 0.0F);
  EXPECT_THROW(loss_of(said, torch::full({1, 1, 1, 3}, nan), {}), DataError);
}

TEST(Training, LearnsDepthFromShadingAndNotFromShuffledPairs) {
  stay_in_this_thread();
  const DepthnetConfig config = small_config();
  double errors[2], mean_depth_error = 0.0;
  for (const bool shuffled : {false, true}) {
    torch::jit::Module network = make_network(config.network, config.seed);
    std::vector<DepthItem> items = dents(network, 0, 32);
    const std::vector<DepthItem> others = dents(network, 100, 12);
    if (shuffled) shuffle_depths(items, config.seed);
    const auto rows = train(network, items, others, config, kNoCheckpoints);
    ASSERT_EQ(rows.size(), 25U);
    EXPECT_EQ(rows.back().judged[3], errors_of(network, others).mae_contact_mm());
    errors[shuffled] = rows.back().judged[3];
  }
  // Always answering the mean depth in contact.
  double sum = 0.0, count = 0.0;
  const auto each_in_contact = [](const auto& take) {
    for (std::size_t i = 100; i < 112; ++i)
      for (const float depth : dent(i).depth_mm.pixels)
        if (depth > kContactMm) take(depth);
  };
  each_in_contact([&](double depth) { sum += depth, ++count; });
  each_in_contact([&](double depth) { mean_depth_error += std::abs(depth - sum / count) / count; });
  EXPECT_LT(errors[0], 0.35 * mean_depth_error);
  EXPECT_GT(errors[1], 2.0 * errors[0]);
}

TEST(Training, WeightsDependNeitherOnThreadsNorOnInterruptions) {
  stay_in_this_thread();
  const DepthnetConfig config = small_config(4);
  const auto trained = [&](std::size_t threads, const Checkpoints& checkpoints) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    torch::jit::Module network = make_network(config.network, config.seed);
    const std::vector<DepthItem> items = dents(network, 0, 10);
    const auto rows = train(network, items, {}, config, checkpoints);
    EXPECT_EQ(rows.size(), 4U);
    return numbers_of(network);
  };
  const std::vector<float> alone = trained(1, kNoCheckpoints);
  EXPECT_EQ(trained(3, kNoCheckpoints), alone);
  std::optional<std::string> kept;
  int saved = 0;
  const Checkpoints keeping{.load = [&] { return kept; },
                            .save =
                                [&](const std::string& bytes) {
                                  kept = bytes;
                                  if (++saved == 2) throw DataError("interrupted");
                                },
                            .between = std::chrono::seconds(0)};
  EXPECT_THROW(trained(2, keeping), DataError);
  EXPECT_EQ(trained(2, keeping), alone);
}

TEST(Training, TakesAnArchiveForNoCheckpoint) {
  stay_in_this_thread();
  const DepthnetConfig config = small_config(2);
  torch::jit::Module network = make_network(config.network, config.seed);
  const std::vector<DepthItem> items = dents(network, 0, 2);
  const ScratchFolder scratch;
  save_script(network, scratch / "model.pt");
  const std::string archive = read_file(scratch / "model.pt");
  for (const std::string& bytes : {archive, archive.substr(0, 20), std::string()})
    EXPECT_THROW(train(network, items, {}, config,
                       {.load = [&] { return std::optional(bytes); }, .save = [](const std::string&) {}}),
                 DataError);
}

}  // namespace train_test
}  // namespace tacipc
