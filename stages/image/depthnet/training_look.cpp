#include "stages/image/depthnet/training_look.h"

#include <algorithm>

#include "common/base/each_in_threads.h"
#include "stages/image/depthnet/augment.h"

namespace tacipc {
namespace {

constexpr std::size_t kMostItems = 512, kLooks = 512;
constexpr std::size_t kLeastDraws = 1, kMostDraws = 16;  // augmented draws per item, in addition to the item itself

/// Background and image from a network's input, (1, 6, h, w).
std::pair<FloatImage, FloatImage> images_of(const torch::Tensor& input) {
  const torch::Tensor rows = input.squeeze(0).permute({1, 2, 0}).contiguous();
  const auto height = static_cast<int>(rows.size(0)), width = static_cast<int>(rows.size(1));
  std::pair<FloatImage, FloatImage> both{FloatImage(width, height, 3), FloatImage(width, height, 3)};
  const float* values = rows.data_ptr<float>();
  for (std::size_t i = 0; i < both.first.pixels.size(); ++i) {
    const std::size_t pixel = i / 3, channel = i % 3;
    both.first.pixels[i] = values[6 * pixel + 3 + channel];
    both.second.pixels[i] = both.first.pixels[i] + values[6 * pixel + channel];
  }
  return both;
}

ImageLook look_of_input(const torch::Tensor& input) {
  const auto [background, image] = images_of(input);
  return look_of(background, image);
}

/// Name of an item's sample, from the item's name.
std::string sample_of(const DepthItem& item) { return item.name.substr(0, item.name.rfind('/')); }

}  // namespace

TrainedLook training_look(const std::vector<DepthItem>& items, const ImageSize& size, const DepthnetConfig& config) {
  std::vector<std::size_t> all, some;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].size == size) all.push_back(i);
  const std::size_t count = std::min(all.size(), kMostItems);
  for (std::size_t k = 0; k < count; ++k) some.push_back(all[k * all.size() / count]);
  const std::size_t draws = std::clamp(kLooks / count, kLeastDraws, kMostDraws);
  std::vector<std::vector<ImageLook>> looks(count);
  each_in_threads(count, [&](std::size_t k) {
    stay_in_this_thread();
    const torch::NoGradGuard no_gradients;
    const DepthItem& item = items[some[k]];
    looks[k].push_back(look_of_input(example_of(item).input));
    for (std::size_t draw = 1; draw <= draws; ++draw)
      looks[k].push_back(
          look_of_input(augmented(item, config.augmentation, config.seed, static_cast<int>(draw), some[k]).input));
  });
  std::vector<std::vector<ImageLook>> groups;
  for (std::size_t k = 0; k < count; ++k) {
    if (k == 0 || sample_of(items[some[k]]) != sample_of(items[some[k - 1]])) groups.emplace_back();
    groups.back().insert(groups.back().end(), looks[k].begin(), looks[k].end());
  }
  return TrainedLook::of(groups, config.network.reduction);
}

LookComparison compare(const TrainedLook& look, const DepthItem& item) {
  const auto [background, image] = images_of(example_of(item).input);
  return look.compare(background, image);
}

}  // namespace tacipc
