// Grasps of a packed dataset: what both fingers see once they have closed, and what became of the object.
#pragma once

#include <torch/script.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stages/image/depthnet/network.h"

namespace tacipc {

struct GraspItem {
  std::string name;  // the pack's `grasp`: id of the left finger
  std::string object;
  std::string split;
  std::string outcome;
  bool held = false;         // outcome `lifted`
  double grip_n = 0.0;       // mean of both fingers
  double seen_s = 0.0;       // time of the last image that is used since the fingers had closed
  double slip_mm = 0.0;      // slip by then
  torch::Tensor fingers[2];  // left, right: change against the reference, codes as `reduced`, f16 (frames, 3, h, w)
};

/// The grasps of shards, by name. Both fingers of a grasp are found whatever shards they are in. Of each finger the
/// first frame, the reference, and the first `frames` rendered ones since the fingers have closed, the last one of the
/// first `close` being the first of them: the object is still held in it, and free afterwards. Later ones are not read.
/// Samples that are no fingers are passed over, and, with a warning, grasps of which a finger or one of these frames is
/// missing. `network` has the method `reduced`.
/// \throw DataError naming the shard if it is damaged, lacks images or the label, or if one of these frames is the one
/// that the outcome was judged in, or a later one
std::vector<GraspItem> read_grasps(const std::vector<std::pair<std::string, std::filesystem::path>>& shards, int frames,
                                   const torch::jit::Module& network);

}  // namespace tacipc
