// Tactile images with their references and depths, for training and evaluating a network.
#pragma once

#include <torch/script.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "stages/image/depthnet/network.h"

namespace tacipc {

/// Indentation beyond which a pixel counts as in contact, as in configs/metrics/depth.yaml.
inline constexpr double kContactMm = 0.02;

/// Image of a sample, packed or rendered.
struct DepthImage {
  std::string name = {};   // "star_00017/frame_0006"
  std::string split = {};  // train, val or test; empty for a render folder
  ByteImage image = {};
  ByteImage reference = {};  // the sample's first frame, without contact
  FloatImage depth_mm = {};  // indentation; NaN outside the gel
};
using TakeDepthImage = std::function<void(const DepthImage&)>;

/// Reads the images of a shard's samples in these splits: each sample's frames after the first, which is their
/// reference, or only its last one.
/// \throw DataError, naming the shard, if it is damaged, holds no images or no indentation, or their sizes differ
void read_packed(const std::filesystem::path& shard, const std::vector<std::string>& splits, bool last_frame,
                 const TakeDepthImage& take);

/// Reads the images of a folder that render wrote.
void read_rendered(const std::filesystem::path& folder, bool last_frame, const TakeDepthImage& take);

/// Image at the network's resolution, f16. Consecutive images with the same reference share it.
struct DepthItem {
  std::string name;
  ImageSize size;           // size of the image
  torch::Tensor change;     // (3, h, w), image − reference, grey levels
  torch::Tensor reference;  // (3, h, w), grey levels
  torch::Tensor depth_mm;   // (1, h, w), NaN outside the gel
};

/// Reduces the image to the network's input.
/// \throw DataError, starting with its name, if no pixel has a depth
DepthItem item_of(const DepthImage& image, const torch::jit::Module& network, int reduction);

}  // namespace tacipc
