// The network as a TorchScript module; the trained module is the delivered one.
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

/// Makes a U-Net without normalisation, with weights drawn by He et al. 2015 from the seed. Methods, N images each:
/// - `forward(image, reference)`: u8 (N, H, W, 3) both, or one reference for all → indentation in mm, f32 (N, H, W)
/// - `reduced(image, reference)`: the same arguments → input of the network, f32 (N, 6, h, w) (define_reduced)
/// - `indentation(x)`: that input → mm, f32 (N, 1, h, w)
torch::jit::Module make_network(const NetworkConfig& config, std::uint64_t seed);

/// Weights of the network, in the order in which they were made. They share memory with the module.
std::vector<torch::Tensor> weights_of(const torch::jit::Module& network);
/// A tensor's numbers.
/// \pre f32
std::vector<float> numbers_of(const torch::Tensor& tensor);
/// Number of weights.
std::int64_t count_weights(const torch::jit::Module& network);

/// Rows and columns of an image.
using ImageSize = std::pair<int, int>;

/// A trained network and the image sizes of its training. Only for these sizes is the size of a pixel in mm known.
struct TrainedNetwork {
  std::string file;  // file name, which begins messages
  torch::jit::Module module;
  std::vector<ImageSize> sizes;
  std::map<ImageSize, TrainedLook> looks =
      {};  // statistics of the training images; networks of earlier versions have none

  /// Indentation of an image, mm.
  /// \throw DataError, starting with `name`, if the image does not have a size of the training or that of its reference
  /// \throw DataError, with the network's name and `name`, if a prediction is not finite
  FloatImage depth_mm(const std::string& name, const ByteImage& image, const ByteImage& reference) const;
};

/// Compares an image with the images of the training.
/// \return nothing if the network has no statistics for this size
std::optional<LookComparison> compare(const TrainedNetwork& network, const ByteImage& image,
                                      const ByteImage& reference);

/// File form of the network for images of one size.
/// \pre the module is make_network(config, …)
DepthModel depth_model_of(const torch::jit::Module& module, const NetworkConfig& config, const ImageSize& size,
                          const TrainedLook* look = nullptr);
/// Loads the network of depth_model_of for images of the files' sizes.
/// \pre there is a file
/// \throw DataError, naming a file that is not such a network or holds another network than the first file
TrainedNetwork load_network(const std::vector<std::filesystem::path>& files);

/// Writes the module as TorchScript for PyTorch programs. TacIPC itself never reads it, because such a file is a
/// program. The same network gives the same bytes.
void save_script(const torch::jit::Module& module, const std::filesystem::path& file);

/// Copy of an image as u8 (1, H, W, 3).
/// \pre three channels
torch::Tensor tensor_of(const ByteImage& image);

/// Keeps each computation of libtorch in the thread that calls it, so that results do not depend on the number of
/// threads. Every thread must call this before it calls libtorch.
void stay_in_this_thread();

}  // namespace tacipc
