#include "stages/dataset/survey/drop.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include "common/base/error.h"
#include "common/base/sha256.h"
#include "tests/stages/dataset/survey/planned_dataset.h"

namespace tacipc {
namespace drop_test {

namespace fs = std::filesystem;

/// Four samples, of which all but the last are made; columns of the manifest in an order of their own.
class Drop : public ::testing::Test {
 protected:
  Drop() {
    std::string csv = "status,id,press_sha256,shard,render_sha256\n";
    for (int i = 0; i < 3; ++i) {
      data_.make(i);
      csv += fmt::format("made,{},{},{},{}\n", data_.id(i), sha256_of_file(data_.sample(i) / "press/press.yaml"),
                         data_.shard(i), sha256_of_file(data_.sample(i) / "render/render.yaml"));
    }
    data_.fail(3);
    csv += fmt::format("failed,{},,{},\n", data_.id(3), data_.shard(3));
    write_file(data_ / "pack/manifest.csv", csv);
  }
  /// Whether the outputs of a stage are gone and its record and times are there.
  bool dropped(int i, const std::string& stage) const {
    const fs::path folder = data_.sample(i) / stage;
    EXPECT_TRUE(fs::exists(folder / (stage + ".yaml")));
    EXPECT_TRUE(fs::exists(folder / (stage + ".timings.yaml")));
    const bool gone = stage == "press" ? !fs::exists(folder / "log.csv") && !fs::exists(folder / "frames")
                                       : !fs::exists(folder / "a: b.png");
    EXPECT_EQ(gone, fs::exists(folder / ".dropped"));
    return gone;
  }

  PlannedDataset data_{4};
};

TEST_F(Drop, TakesOutputsOfPackedSamplesAndNothingTwice) {
  const Dropped first = drop_packed(data_.path(), {"press", "render"}, false);
  EXPECT_EQ(first.stages, 6u);
  EXPECT_EQ(first.samples, 0u);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(dropped(i, "press") && dropped(i, "render")) << i;
  EXPECT_EQ(drop_packed(data_.path(), {"press", "render"}, false).stages, 0u);
}

TEST_F(Drop, OneStageOfWholeShards) {
  EXPECT_EQ(drop_packed(data_.path(), {"press"}, true).stages, 2u);
  EXPECT_TRUE(dropped(0, "press") && dropped(1, "press"));
  EXPECT_FALSE(dropped(2, "press"));  // its shard is packed again when the failed one is made
  EXPECT_FALSE(dropped(0, "render"));
}

TEST_F(Drop, LeavesWhatIsNotAsItWasPackedOrBeingMade) {
  data_.file(0, "press/press.yaml", "stage: press\noutputs:\n  log.csv: made anew\n");
  data_.file(1, "render/.making", "");
  const int lock = ::open((data_.sample(1) / "render/.making").c_str(), O_RDWR);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  const Dropped dropped_now = drop_packed(data_.path(), {"press"}, false);
  ::close(lock);
  EXPECT_EQ(dropped_now.stages, 1u);
  EXPECT_EQ(dropped_now.samples, 2u);
  EXPECT_FALSE(dropped(0, "press"));
  EXPECT_FALSE(dropped(1, "press"));
  EXPECT_TRUE(dropped(2, "press"));
}

TEST_F(Drop, SaysWhyNothingIsRemoved) {
  const auto message = [&] { return message_of<DataError>([&] { drop_packed(data_.path(), {"press"}, false); }); };
  const std::string manifest = (data_ / "pack/manifest.csv").string();
  write_file(manifest, "id,status,shard,press_sha256\n");
  EXPECT_EQ(message(), manifest + " has no render_sha256; pack it again; nothing is removed");
  fs::remove(manifest);
  EXPECT_EQ(message(), data_.path().string() + " is not packed; nothing is removed");
}

}  // namespace drop_test
}  // namespace tacipc
