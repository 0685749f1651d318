#include "stages/image/calibrate/train_network.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "common/base/rng.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace train_network_test {

NetworkSamples random_samples(Eigen::Index count) {
  NetworkSamples samples{.inputs = Eigen::MatrixXf(5, count), .targets = Eigen::MatrixXf(3, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index k = 0; k < 5; ++k)
      samples.inputs(k, i) = static_cast<float>(random_uniform(7, 0, static_cast<std::uint64_t>(5 * i + k)));
    samples.targets(0, i) = samples.inputs(2, i) - 0.5F;
    samples.targets(1, i) = 0.3F * samples.inputs(3, i) * samples.inputs(0, i);
    samples.targets(2, i) = -0.2F;
  }
  return samples;
}

TEST(TrainNetwork, TheGradientIsThatOfFiniteDifferences) {
  const NetworkSamples samples = random_samples(64);
  LightNetwork network = initial_network(3), gradient, unused;
  DropoutMasks masks;
  for (std::size_t l = 0; l < masks.size(); ++l) {
    masks[l] = Eigen::MatrixXf::Constant(32, 64, 1.0F / 0.95F);
    for (Eigen::Index i = 0; i < 64; i += 7) masks[l](static_cast<Eigen::Index>(3 * l) + i % 5, i) = 0.0F;
  }
  loss_and_gradient(network, samples, masks, gradient);
  constexpr float kStep = 2e-3F;
  const auto expect_slope = [&](float& parameter, float derivative, const std::string& which) {
    const float before = parameter;
    parameter = before + kStep;
    const double above = loss_and_gradient(network, samples, masks, unused);
    parameter = before - kStep;
    const double below = loss_and_gradient(network, samples, masks, unused);
    parameter = before;
    const double slope = (above - below) / (2.0 * double{kStep});
    EXPECT_NEAR(double{derivative}, slope, 2e-5 + 0.02 * std::abs(slope)) << which;
  };
  for (std::size_t l = 0; l < LightNetwork::kLayers; ++l) {
    for (const auto& [row, column] : {std::pair{0, 0}, {1, 3}, {2, 4}})
      expect_slope(network.layers[l].weights(row, column), gradient.layers[l].weights(row, column),
                   "layer " + std::to_string(l) + ", " + std::to_string(row) + ", " + std::to_string(column));
    expect_slope(network.layers[l].bias[1], gradient.layers[l].bias[1], "layer " + std::to_string(l));
  }
}

TEST(TrainNetwork, TheLossIsThatOfTheNetworkInUse) {
  const NetworkSamples samples = random_samples(50);
  const LightNetwork network = initial_network(1);
  LightNetwork gradient;
  const double expected = (network.forward(samples.inputs) - samples.targets).cast<double>().squaredNorm() / 150.0;
  EXPECT_NEAR(loss_and_gradient(network, samples, {}, gradient), expected, 1e-9);
}

TEST(TrainNetwork, ASeedGivesEqualWeightsAndAnotherOthers) {
  const NetworkSamples samples = random_samples(300);
  NetworkFit settings{.epochs = 3, .batch = 100, .rate = 1e-3, .dropout = 0.05, .seed = 1};
  const LightNetwork a = train_network(samples, settings), b = train_network(samples, settings);
  settings.seed = 2;
  const LightNetwork c = train_network(samples, settings);
  for (std::size_t l = 0; l < LightNetwork::kLayers; ++l) {
    EXPECT_EQ(a.layers[l].weights, b.layers[l].weights);
    EXPECT_EQ(a.layers[l].bias, b.layers[l].bias);
    EXPECT_NE(a.layers[l].weights, c.layers[l].weights);
  }
}

TEST(TrainNetwork, ASmoothFunctionIsLearnt) {
  const NetworkSamples samples = random_samples(2000);
  LightNetwork gradient;
  const LightNetwork network =
      train_network(samples, {.epochs = 60, .batch = 100, .rate = 3e-3, .dropout = 0.0, .seed = 1});
  EXPECT_LT(std::sqrt(loss_and_gradient(network, samples, {}, gradient)), 0.02);
  const double nothing =
      std::sqrt(samples.targets.cast<double>().squaredNorm() / static_cast<double>(samples.targets.size()));
  EXPECT_GT(nothing, 0.2);
}

TEST(NetworkSamples, FlatAndClippedPixelsAreLeftOut) {
  const ContactPixel good{
      .x = 10, .y = 20, .slope_x = 0.75, .slope_y = 0.0, .target = {25.5, 0, -51}, .used = {true, true, true}};
  ContactPixel flat = good, clipped = good;
  flat.slope_x = 0.0;
  clipped.used[1] = false;
  const NetworkSamples samples = network_samples({{flat, good}, {clipped}}, 40, 80);
  ASSERT_EQ(samples.inputs.cols(), 1);
  EXPECT_FLOAT_EQ(samples.inputs(0, 0), 0.25F);
  EXPECT_FLOAT_EQ(samples.inputs(2, 0), 0.2F);
  EXPECT_FLOAT_EQ(samples.targets(0, 0), 0.1F);
  EXPECT_FLOAT_EQ(samples.targets(2, 0), -0.2F);
  EXPECT_NE(message_of<DataError>([] { train_network(network_samples({{}}, 4, 4), {.epochs = 1, .batch = 1}); }), "");
}

}  // namespace train_network_test
}  // namespace tacipc
