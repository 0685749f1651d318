#include "stages/image/depthnet/grasp_set.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/sample/shard_list.h"
#include "stages/image/depthnet/outcome_network.h"
#include "tests/stages/image/depthnet/dents.h"
#include "tests/stages/image/depthnet/grasps.h"

namespace tacipc {
namespace grasp_set_test {

std::vector<GraspItem> read(const std::filesystem::path& list, int frames) {
  return read_grasps(listed_shards(list), frames, make_outcome_network(small_outcome(), 1));
}

std::string refusal(const std::filesystem::path& list, int frames) {
  try {
    read(list, frames);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

TEST(Grasps, AreBothFingersFromTheEndOfClosingOn) {
  stay_in_this_thread();
  const ScratchFolder scratch;
  const std::vector<MadeGrasp> made = made_grasps(2, true);
  const std::vector<GraspItem> items = read(write_grasps(scratch, made), 2);
  ASSERT_EQ(items.size(), made.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    EXPECT_EQ(items[i].name, fmt::format("s{:03}", 2 * i));
    EXPECT_EQ(items[i].object, made[i].object);
    EXPECT_EQ(items[i].split, made[i].split);
    EXPECT_EQ(items[i].held, made[i].outcome == "lifted");
    EXPECT_NEAR(items[i].grip_n, made[i].grip_n, 1e-9);
    EXPECT_NEAR(items[i].seen_s, 0.01, 1e-9);
    EXPECT_NEAR(items[i].slip_mm, 0.75, 1e-6);
    for (std::size_t f = 0; f < 2; ++f) {
      ASSERT_EQ(items[i].fingers[f].sizes(), (std::vector<std::int64_t>{2, 3, kGraspSize, kGraspSize}));
      for (std::int64_t k = 0; k < 2; ++k) {
        const ByteImage image = made_image(made[i], i, f, kClosed + static_cast<std::size_t>(k));
        for (int y = 0; y < kGraspSize; ++y)
          for (int x = 0; x < kGraspSize; ++x)
            ASSERT_EQ(items[i].fingers[f][k][1][y][x].item<float>(), image.at(x, y, 1) - 120.0F);
      }
    }
  }
}

TEST(Grasps, WithoutEnoughFramesArePassedOverAndJudgedOnesRefused) {
  stay_in_this_thread();
  const ScratchFolder scratch;
  const std::filesystem::path list = write_grasps(scratch, made_grasps(1, true));
  EXPECT_EQ(read(list, 3).size(), 6U);
  EXPECT_THAT(refusal(list, 4), testing::HasSubstr("/data/s000: its outcome was judged in frame 5"));
  EXPECT_TRUE(read(list, 5).empty());
  write_file(scratch / "shards/shards.txt", "lefts/pack.yaml\n");
  EXPECT_TRUE(read(list, 2).empty());
  write_shard(scratch, {"train", "test"});  // presses
  EXPECT_TRUE(read(list, 2).empty());
}

}  // namespace grasp_set_test
}  // namespace tacipc
