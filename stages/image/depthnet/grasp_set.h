// Grasps of a packed dataset: images of both fingers after closing, and the outcome.
#pragma once

#include <torch/script.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "stages/image/depthnet/network.h"

namespace tacipc {

/// One grasp as an example for a network.
struct GraspItem {
  std::string name;  // key `grasp` of the pack: id of the left finger
  std::string object;
  std::string split;
  std::string outcome;
  bool held = false;         // true for the outcome `lifted`
  double grip_n = 0.0;       // grip force, mean of both fingers
  double seen_s = 0.0;       // time from closing to the last image in use
  double slip_mm = 0.0;      // slip until that image
  torch::Tensor fingers[2];  // left and right finger: change against the reference, grey levels as from `reduced`, f16
                             // (frames, 3, h, w)
};

/// Reads the grasps of shards, by name; both fingers of a grasp may be in any shard. For each finger it reads the first
/// frame, which is the reference, and the first `frames` rendered ones after closing. The first of these is the last
/// frame of the first `close`: the object is still held in it, and free afterwards. Later frames are not read. Samples
/// that are not fingers are skipped. A grasp that lacks a finger or one of these frames is skipped with a warning.
/// \param network module with the method `reduced`
/// \throw DataError, naming the shard, if it is damaged, lacks images or the label, or if the outcome was judged in one
/// of these frames or before
std::vector<GraspItem> read_grasps(const std::vector<std::pair<std::string, std::filesystem::path>>& shards, int frames,
                                   const torch::jit::Module& network);

}  // namespace tacipc
