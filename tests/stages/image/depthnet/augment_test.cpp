#include "stages/image/depthnet/augment.h"

#include <gtest/gtest.h>

#include "stages/image/depthnet/network.h"
#include "tests/stages/image/depthnet/dents.h"

namespace tacipc {
namespace augment_test {

TEST(Augmentation, MovesImageReferenceAndDepthTogether) {
  const torch::jit::Module network = make_network({.levels = 1, .base_channels = 1, .reduction = 1}, 1);
  const DepthItem item = item_of(dent(0), network, 1);
  const DepthExample plain = example_of(item);
  EXPECT_TRUE(augmented(item, {}, 1, 1, 0).input.equal(plain.input));
  const AugmentationConfig shifts{.shift_px = 3};
  bool moved = false;
  for (int epoch = 1; epoch < 6; ++epoch) {
    const DepthExample example = augmented(item, shifts, 1, epoch, 0);
    EXPECT_EQ(example.input.sizes(), plain.input.sizes());
    // The largest depth and the largest change have moved by the same vector.
    const auto top = [](const torch::Tensor& image) { return image.argmax().item<std::int64_t>(); };
    const auto by = top(example.depth_mm[0][0]) - top(plain.depth_mm[0][0]);
    EXPECT_EQ(top(example.input[0][0]) - top(plain.input[0][0]), by);
    EXPECT_LE(std::abs(std::lround(static_cast<double>(by) / kSize)), 3);
    moved = moved || by != 0;
  }
  EXPECT_TRUE(moved);
  // Gains and drifts stay within their sizes, and differ between epochs.
  const AugmentationConfig light{.gain = 0.1, .drift_codes = 4.0};
  const torch::Tensor first = augmented(item, light, 1, 1, 0).input, second = augmented(item, light, 1, 2, 0).input;
  EXPECT_FALSE(first.equal(second));
  const torch::Tensor limit = 0.1 * plain.input.narrow(1, 0, 3).abs() + 4.001;
  EXPECT_TRUE(((first - plain.input).narrow(1, 0, 3).abs() <= limit).all().item<bool>());
  EXPECT_TRUE((first - plain.input).narrow(1, 3, 3).eq(0).all().item<bool>());
}

}  // namespace augment_test
}  // namespace tacipc
