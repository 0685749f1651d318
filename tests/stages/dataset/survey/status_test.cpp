#include "stages/dataset/survey/status.h"

#include <gtest/gtest.h>

#include <ctime>

#include "common/base/error.h"
#include "tests/stages/dataset/survey/planned_dataset.h"

namespace tacipc {
namespace status_test {

TEST(DatasetStatus, CountsWhatIsMadeFailedAndLeft) {
  const PlannedDataset data(6);
  data.make(0);
  data.make(1);
  data.fail(2);
  data.file(3, "press/press.yaml", "stage: press\n");  // interrupted
  const DatasetStatus all = dataset_status(data.path(), {}, std::time(nullptr) + 60);
  EXPECT_EQ(all.samples, 6u);
  EXPECT_EQ(all.made, 2u);
  EXPECT_EQ(all.failed, 1u);
  EXPECT_EQ(all.running, 0u);
  EXPECT_EQ(all.left(), 3u);
  EXPECT_EQ(all.made_recently, 2u);
  EXPECT_NEAR(all.recent_seconds, 60.0, 5.0);
  EXPECT_EQ(dataset_status(data.path(), {}, std::time(nullptr) + 700).made_recently, 0u);

  const DatasetStatus part = dataset_status(data.path(), {.first = 1, .end = 3}, std::time(nullptr));
  EXPECT_EQ(part.samples, 2u);
  EXPECT_EQ(part.made, 1u);
  EXPECT_EQ(part.failed, 1u);
}

TEST(DatasetStatus, SaysHowFastAndWhatFailed) {
  const DatasetStatus status{
      .samples = 100, .made = 40, .failed = 2, .running = 3, .made_recently = 30, .recent_seconds = 600.0};
  EXPECT_EQ(to_text(status, "out/datasets/set/"),
            "set: 100 samples: 40 made, 2 failed, 3 running, 58 left\n"
            "  3.0 per minute recently; the rest takes 0.32 hours at this rate\n"
            "  reasons in out/datasets/set//failures.csv; again: make -f Makefile.data retry CONFIG=...\n");
  EXPECT_EQ(to_text({.samples = 2, .made = 2, .made_recently = 2}, "set"),
            "set: 2 samples: 2 made, 0 failed, 0 running, 0 left\n");
}

TEST(DatasetStatus, ATableThatIsNotWholeIsAFault) {
  const PlannedDataset data(2);
  const std::string table = (data / "plan/samples.csv").string();
  const std::string damaged =
      " rows where there should be {}: it is damaged or being made again; if this persists: make -f Makefile.data "
      "clean-plan CONFIG=...";
  const auto message = [&](const IndexRange& range) {
    return message_of<DataError>([&] { dataset_status(data.path(), range, 0); });
  };
  EXPECT_EQ(message({.first = 0, .end = 5}), table + " has 2" + fmt::format(fmt::runtime(damaged), 5));
  write_file(table, "id,index,split,split_pose,seed,sensor,mesh,object,motion,shard,folder\n");
  EXPECT_EQ(message({}), table + " has 0" + fmt::format(fmt::runtime(damaged), 1));
  std::filesystem::remove(table);
  EXPECT_EQ(message({}), "there is no " + table + " yet: make -f Makefile.data plan CONFIG=...");
}

}  // namespace status_test
}  // namespace tacipc
