#include "stages/image/depthnet/training_set.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "stages/image/depthnet/network.h"
#include "tests/stages/image/depthnet/dents.h"

namespace tacipc {
namespace training_set_test {

TEST(DepthItem, IsMeansOverSquaresAndKnowsWhatIsBesideTheGel) {
  const torch::jit::Module network = make_network({.levels = 1, .base_channels = 1, .reduction = 2}, 1);
  DepthImage image{.name = "a",
                   .image = ByteImage(3, 2, 3, 10),
                   .reference = ByteImage(3, 2, 3, 8),
                   .depth_mm = FloatImage(3, 2, 1, 0.5F)};
  image.image.at(0, 0, 1) = 30;  // one of four
  image.depth_mm.at(2, 1, 0) = std::nanf("");
  image.depth_mm.at(1, 1, 0) = 0.9F;
  const DepthItem item = item_of(image, network, 2);
  ASSERT_EQ(item.change.sizes(), (std::vector<std::int64_t>{3, 1, 2}));
  EXPECT_EQ(item.change[0][0][0].item<float>(), 2.0F);
  EXPECT_EQ(item.change[1][0][0].item<float>(), 7.0F);
  EXPECT_EQ(item.change[1][0][1].item<float>(), 2.0F);  // a half square at the border
  EXPECT_EQ(item.reference[2][0][1].item<float>(), 8.0F);
  EXPECT_NEAR(item.depth_mm[0][0][0].item<float>(), 0.6, 1e-3);
  EXPECT_TRUE(std::isnan(item.depth_mm[0][0][1].item<float>()));
  for (float& depth : image.depth_mm.pixels) depth = std::nanf("");
  EXPECT_THROW(item_of(image, network, 2), DataError);
}

TEST(PackedImages, AreThoseOfTheSplitsAsked) {
  const ScratchFolder scratch;
  const std::filesystem::path shard = write_shard(scratch, {"train", "val", "test", "train"});
  const std::vector<std::size_t> dents_in_order{0, 1, 2, 3, 6, 7};  // two a sample; 4 and 5 are for the test
  std::vector<std::string> names;
  read_packed(shard, {"train", "val"}, false, [&](const DepthImage& image) {
    names.push_back(image.split + " " + image.name);
    const DepthImage expected = dent(dents_in_order.at(names.size() - 1));
    EXPECT_EQ(image.image.pixels, expected.image.pixels);
    EXPECT_EQ(image.reference.pixels, expected.reference.pixels);
    EXPECT_EQ(image.depth_mm.pixels, expected.depth_mm.pixels);
  });
  EXPECT_THAT(names, testing::ElementsAre("train s0/frame_0001", "train s0/frame_0002", "val s1/frame_0001",
                                          "val s1/frame_0002", "train s3/frame_0001", "train s3/frame_0002"));
  names.clear();
  read_packed(shard, {"test"}, true, [&](const DepthImage& image) { names.push_back(image.name); });
  EXPECT_THAT(names, testing::ElementsAre("s2/frame_0002"));
  write_shard(scratch, {"train"}, NumberType::f16);
  EXPECT_THROW(read_packed(shard, {"train"}, false, [](const DepthImage&) {}), DataError);
}

}  // namespace training_set_test
}  // namespace tacipc
