#include "stages/image/depthnet/network.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/rng.h"
#include "stages/image/predict/depth_reader.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace network_test {

TEST(TrainedNetwork, EnlargesItsAnswerToTheImageAndIsTheSameWhenRead) {
  stay_in_this_thread();
  const ScratchFolder scratch;
  for (const int reduction : {1, 2, 3}) {
    const NetworkConfig config{.levels = 2, .base_channels = 6, .reduction = reduction};
    const torch::jit::Module module = make_network(config, 1);
    ByteImage image(31, 22, 3, 90), reference(31, 22, 3, 100);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::uint8_t>(60 + i % 97);
    write_file(scratch / "model.onnx", depth_model_of(module, config, {22, 31}).to_onnx());
    write_file(scratch / "larger.onnx", depth_model_of(module, config, {48, 64}).to_onnx());
    const TrainedNetwork network = load_network({scratch / "model.onnx", scratch / "larger.onnx"});
    EXPECT_EQ(network.sizes, (std::vector<ImageSize>{{22, 31}, {48, 64}}));
    const FloatImage depth = network.depth_mm("a", image, reference);
    // Each pixel lies between the network's own, by the place of its centre.
    const torch::NoGradGuard no_gradients;
    const torch::Tensor small =
        module
            .get_method("indentation")(
                {module.get_method("reduced")({tensor_of(image), tensor_of(reference)}).toTensor()})
            .toTensor()[0][0];
    ASSERT_EQ(small.size(0), (22 + reduction - 1) / reduction);
    ASSERT_EQ(small.size(1), (31 + reduction - 1) / reduction);
    for (int y = 0; y < 22; ++y)
      for (int x = 0; x < 31; ++x) {
        const double u = std::max(0.0, (x + 0.5) / reduction - 0.5), v = std::max(0.0, (y + 0.5) / reduction - 0.5);
        const auto at = [&](int j, int i) {
          return double{
              small[std::min<std::int64_t>(j, small.size(0) - 1)][std::min<std::int64_t>(i, small.size(1) - 1)]
                  .item<float>()};
        };
        const int i = static_cast<int>(u), j = static_cast<int>(v);
        const double p = u - i, q = v - j;
        EXPECT_NEAR(
            depth.at(x, y, 0),
            (1 - q) * ((1 - p) * at(j, i) + p * at(j, i + 1)) + q * ((1 - p) * at(j + 1, i) + p * at(j + 1, i + 1)),
            1e-5)
            << reduction << ' ' << x << ' ' << y;
      }
  }
  EXPECT_THROW(load_network({scratch / "model.onnx"}).depth_mm("a", ByteImage(30, 22, 3), ByteImage(30, 22, 3)),
               DataError);
}

TEST(TrainedNetwork, IsOneNetworkWhateverFilesItIsReadFrom) {
  stay_in_this_thread();
  const ScratchFolder scratch;
  const NetworkConfig config{.levels = 2, .base_channels = 3, .reduction = 1};
  const auto file = [&](const char* name, const NetworkConfig& of, std::uint64_t seed, int width) {
    return scratch.file(name, depth_model_of(make_network(of, seed), of, {22, width}).to_onnx());
  };
  const auto first = file("first.onnx", config, 1, 31), same = file("same.onnx", config, 1, 32),
             other_seed = file("seed.onnx", config, 2, 32),
             other_kind = file("kind.onnx", {.levels = 2, .base_channels = 3, .reduction = 2}, 1, 32);
  EXPECT_EQ(load_network({first, same}).sizes.size(), 2U);
  for (const auto& other : {other_seed, other_kind})
    EXPECT_EQ(message_of<DataError>([&] {
                load_network({first, other});
              }),
              other.string() + ": is another network than " + first.string());
}

TEST(TrainedNetwork, RefusesToAnswerWithWhatIsNoNumber) {
  stay_in_this_thread();
  const ScratchFolder scratch;
  const NetworkConfig config{.levels = 1, .base_channels = 2, .reduction = 1};
  const torch::jit::Module module = make_network(config, 1);
  for (torch::Tensor& weights : weights_of(module)) {
    const torch::NoGradGuard no_gradients;
    weights.fill_(3e38F);
  }
  const auto file = scratch.file("model.onnx", depth_model_of(module, config, {6, 8}).to_onnx());
  const TrainedNetwork network = load_network({file});
  EXPECT_EQ(message_of<DataError>([&] { network.depth_mm("touch", ByteImage(8, 6, 3, 9), ByteImage(8, 6, 3, 5)); }),
            file.string() + ": is damaged: its depth of touch is not finite");
}

TEST(Onnx, OpenCvAnswersAsLibtorchDoes) {
  stay_in_this_thread();
  for (const int reduction : {1, 2, 3})
    for (const auto& [width, height] : {std::pair(31, 22), std::pair(48, 64), std::pair(320, 240)}) {
      const NetworkConfig config{.levels = 3, .base_channels = 6, .reduction = reduction};
      torch::jit::Module module = make_network(config, 7);
      std::uint64_t drawn = 0;
      for (torch::Tensor& weights : weights_of(module)) {
        const torch::NoGradGuard no_gradients;
        if (weights.dim() == 1)  // all zero before a training
          for (std::int64_t k = 0; k < weights.numel(); ++k) weights[k] = random_uniform(1, 4, drawn++) - 0.5;
      }
      ByteImage image(width, height, 3), reference(width, height, 3);
      for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = static_cast<std::uint8_t>(random_bits(1, 2, i) % 256);
        reference.pixels[i] = static_cast<std::uint8_t>(random_bits(1, 3, i) % 256);
      }
      const DepthModel model =
          DepthModel::from_onnx(depth_model_of(module, config, {height, width}).to_onnx(), "model");
      const FloatImage expected =
          TrainedNetwork{.file = "model", .module = module, .sizes = {{height, width}}}.depth_mm("a", image, reference);
      const FloatImage read = DepthReader(model, "model").depth_mm("a", image, reference);
      ASSERT_EQ(read.width, width);
      float largest = 0.0F;
      for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
        ASSERT_NEAR(read.pixels[i], expected.pixels[i], 1e-5) << reduction << ' ' << width << ' ' << i;
        largest = std::max(largest, std::abs(expected.pixels[i]));
      }
      EXPECT_GT(largest, 0.1F);
    }
}

}  // namespace network_test
}  // namespace tacipc
