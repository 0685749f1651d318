// The network as a TorchScript module: what is trained is what is delivered.
#pragma once

#include <torch/script.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/benchmark/depth_model.h"
#include "common/benchmark/trained_look.h"
#include "common/image/image.h"
#include "stages/image/depthnet/depthnet_config.h"

namespace tacipc {

/// A U-Net without normalisation, weights drawn by He et al. 2015 from the seed. Methods, N images each:
/// - `forward(image, reference)`: u8 (N, H, W, 3) both, or one reference for all → indentation in mm, f32 (N, H, W)
/// - `reduced(image, reference)`: the same arguments → what the network sees, f32 (N, 6, h, w) (define_reduced)
/// - `indentation(x)`: that → mm, f32 (N, 1, h, w)
torch::jit::Module make_network(const NetworkConfig& config, std::uint64_t seed);

/// Its weights, in the order they were made. They share memory with the module.
std::vector<torch::Tensor> weights_of(const torch::jit::Module& network);
/// A tensor's numbers. \pre f32
std::vector<float> numbers_of(const torch::Tensor& tensor);
/// How many numbers the weights are.
std::int64_t count_weights(const torch::jit::Module& network);

/// Rows and columns of an image.
using ImageSize = std::pair<int, int>;

/// A trained network, and the sizes of the images it was trained on: it knows what a pixel is in mm only for these.
struct TrainedNetwork {
  std::string file;  // begins messages
  torch::jit::Module module;
  std::vector<ImageSize> sizes;
  std::map<ImageSize, TrainedLook> looks = {};  // of the training's images; those of earlier versions have none

  /// The indentation of an image, mm. \throw DataError, which begins with the name, if the image is of another size
  /// than those, or not of its reference's; with the network's name and this one, if an answer is not finite
  FloatImage depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference) const;
};

/// How an image compares with those of the training; nothing if the network has no look of this size.
std::optional<LookComparison> compare(const TrainedNetwork& network, const ByteImage& image,
                                      const ByteImage& reference);

/// The network as a file for images of one size. \pre the module is make_network(config, …)
DepthModel depth_model_of(const torch::jit::Module& module, const NetworkConfig& config, const ImageSize& size,
                          const TrainedLook* look = nullptr);
/// The network of depth_model_of, for images of the files' sizes. \throw DataError naming a file that is no such one or
/// of another network than the first \pre there is a file
TrainedNetwork load_network(const std::vector<std::filesystem::path>& files);

/// Writes the module as TorchScript, for programs of PyTorch; none of ours reads it, as it is a program. The same
/// network makes the same bytes.
void save_script(const torch::jit::Module& module, const std::filesystem::path& file);

/// u8 (1, H, W, 3), a copy. \pre three channels
torch::Tensor tensor_of(const ByteImage& image);

/// Results do not depend on the number of threads: each computation stays in the thread that asks for it. For every
/// thread that calls libtorch, before it does.
void stay_in_this_thread();

}  // namespace tacipc
