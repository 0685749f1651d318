// Tactile images with their references and depths, as a network is trained and judged on them.
#pragma once

#include <torch/script.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "stages/image/depthnet/network.h"

namespace tacipc {

/// In contact is what is pressed deeper, as in configs/metrics/depth.yaml.
inline constexpr double kContactMm = 0.02;

/// An image of a sample, as it was packed or rendered.
struct DepthImage {
  std::string name = {};   // "star_00017/frame_0006"
  std::string split = {};  // train, val or test; empty of a render folder
  ByteImage image = {};
  ByteImage reference = {};  // the sample's first frame, without contact
  FloatImage depth_mm = {};  // indentation; NaN beside the gel
};
using TakeDepthImage = std::function<void(const DepthImage&)>;

/// The images of a shard's samples of those splits: each sample's frames after the first, which is their reference, or
/// its last one alone. \throw DataError naming the shard if it is damaged, holds no images or no indentation, or such
/// of different sizes
void read_packed(const std::filesystem::path& shard, const std::vector<std::string>& splits, bool last_frame,
                 const TakeDepthImage& take);

/// The same of a folder that render wrote.
void read_rendered(const std::filesystem::path& folder, bool last_frame, const TakeDepthImage& take);

/// At the network's resolution, f16. Consecutive images with the same reference share it.
struct DepthItem {
  std::string name;
  ImageSize size;           // of the image
  torch::Tensor change;     // (3, h, w), image − reference, codes
  torch::Tensor reference;  // (3, h, w), codes
  torch::Tensor depth_mm;   // (1, h, w), NaN beside the gel
};

/// The image as the network sees it. \throw DataError, which begins with the name, if no pixel has a depth
DepthItem item_of(const DepthImage& image, const torch::jit::Module& network, int reduction);

}  // namespace tacipc
