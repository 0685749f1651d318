#include "common/rival/light_network.h"

#include <gtest/gtest.h>

#include "common/base/error.h"
#include "common/format/npy.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace light_network_test {

TEST(LightNetwork, HasThePublishedNumberOfParameters) { EXPECT_EQ(num_parameters(), 2403); }

TEST(LightNetwork, InputsAreThePlaceAndTheNormalHalved) {
  const auto input = LightNetwork::input(80, 60, 320, 240, 0.75, 0.0);  // normal (−0.6, 0, 0.8)
  EXPECT_FLOAT_EQ(input[0], 0.25F);
  EXPECT_FLOAT_EQ(input[1], 0.25F);
  EXPECT_FLOAT_EQ(input[2], 0.2F);
  EXPECT_FLOAT_EQ(input[3], 0.5F);
  EXPECT_FLOAT_EQ(input[4], 0.9F);
}

TEST(LightNetwork, TwoLayersAreRectifiedAndTheThirdIsNot) {
  LightNetwork network;
  for (std::size_t l = 0; l < LightNetwork::kLayers; ++l) network.layers[l].weights(0, 0) = -1.0F;
  network.layers[0].bias[0] = 3.0F;  // 3 − x
  network.layers[1].bias[0] = 4.0F;  // 4 − 2, then −2, then 2
  Eigen::MatrixXf inputs = Eigen::MatrixXf::Zero(5, 2);
  inputs(0, 0) = 1.0F;
  inputs(0, 1) = 5.0F;  // 3 − 5 is cut to 0: 4, −4, 4
  const Eigen::MatrixXf out = network.forward(inputs);
  EXPECT_EQ(out(0, 0), 2.0F);
  EXPECT_EQ(out(0, 1), 4.0F);
  EXPECT_EQ(out(2, 1), 0.0F);
}

TEST(LightNetwork, TheFileComesBackAndOthersAreRefused) {
  const ScratchFolder scratch;
  LightNetwork network;
  network.layers[1].weights(3, 30) = 0.5F;
  network.layers[3].bias[2] = -0.25F;
  network.write(scratch / "network.npy");
  const LightNetwork read = LightNetwork::read(scratch / "network.npy");
  EXPECT_EQ(read.layers[1].weights, network.layers[1].weights);
  EXPECT_EQ(read.layers[3].bias, network.layers[3].bias);
  const double one = 1.0;
  write_npy(scratch / "short.npy", {1}, &one);
  EXPECT_NE(message_of<DataError>([&] { LightNetwork::read(scratch / "short.npy"); }), "");
}

}  // namespace light_network_test
}  // namespace tacipc
