#include "stages/dataset/survey/pack_inputs.h"

#include <gtest/gtest.h>

#include <chrono>

#include "common/base/error.h"
#include "common/base/sha256.h"
#include "tests/stages/dataset/survey/planned_dataset.h"

namespace tacipc {
namespace pack_inputs_test {

namespace fs = std::filesystem;

fs::file_time_type time_at(std::int64_t seconds) {
  return std::chrono::file_clock::from_sys(
      std::chrono::sys_time<std::chrono::nanoseconds>(std::chrono::seconds(seconds)));
}

TEST(PackInputs, HoldRowsAndTimesOfRecords) {
  const PlannedDataset data(3);
  data.make(0);
  data.fail(1);
  fs::last_write_time(data.sample(0) / "press/press.yaml", time_at(1700000000) + std::chrono::nanoseconds(5));
  fs::last_write_time(data.sample(0) / "render/render.yaml", time_at(1700000001));
  fs::last_write_time(data.sample(1) / "press/press.failed.yaml", time_at(1700000002));
  write_pack_inputs(data.path(), data.profile());
  const std::string dataset = "seed: 5\nsplits:\n  val: 0\n";
  EXPECT_EQ(read_file(data / "shards/dataset.yaml"), dataset);
  EXPECT_EQ(read_file(data / "shards/shards.mk"), "PACK_SHARDS := train-00000 train-00001\n");
  EXPECT_EQ(read_file(data / "shards/shards.txt"), "train-00000/pack.yaml\ntrain-00001/pack.yaml\n");
  const auto row = [&](int i) {
    return fmt::format("{0},{1},train,train,7,toy,coarse,star,{2},{3},samples/000/{0}", data.id(i), i, data.motion(i),
                       data.shard(i));
  };
  const std::string common = sha256(dataset) + sha256_of_file(data.profile()) + "\n";
  EXPECT_EQ(
      read_file(data / "shards/train-00000.inputs"),
      common + row(0) + " 1700000000.0000000050  1700000001.0000000000 \n" + row(1) + "  1700000002.0000000000  \n");
  EXPECT_EQ(read_file(data / "shards/train-00001.inputs"), common + row(2) + "    \n");
}

TEST(PackInputs, OnlyWhatChangedIsWrittenAnew) {
  const PlannedDataset data(4);
  write_pack_inputs(data.path(), data.profile());
  const std::vector<std::string> files{"dataset.yaml", "shards.mk", "shards.txt", "train-00000.inputs",
                                       "train-00001.inputs"};
  const auto changed = [&] {
    for (const std::string& file : files) fs::last_write_time(data / ("shards/" + file), time_at(1000));
    write_pack_inputs(data.path(), data.profile());
    std::vector<std::string> names;
    for (const std::string& file : files)
      if (fs::last_write_time(data / ("shards/" + file)) != time_at(1000)) names.push_back(file);
    return names;
  };
  EXPECT_EQ(changed(), std::vector<std::string>{});
  data.fail(3);
  EXPECT_EQ(changed(), std::vector<std::string>{"train-00001.inputs"});
  write_file(data / "plan/dataset.yaml", "seed: 5\nstop_after_failures: 9\nsplits:\n  val: 0\n");
  EXPECT_EQ(changed(), std::vector<std::string>{});
  write_file(data.profile(), "fields: few\n");
  EXPECT_EQ(changed(), (std::vector<std::string>{"train-00000.inputs", "train-00001.inputs"}));
}

TEST(PackInputs, AShardThatIsAsItWasPackedIsNotPackedAgain) {
  const PlannedDataset data(2);
  write_pack_inputs(data.path(), data.profile());
  const fs::path inputs = data / "shards/train-00000.inputs", shard = data / "shards/train-00000";
  write_file(shard / "pack.yaml", "stage: pack\n");
  write_file(shard / "packed.inputs", read_file(inputs));
  fs::last_write_time(shard / "pack.yaml", time_at(2000));
  write_file(inputs, "of a packing that was refused\n");
  write_pack_inputs(data.path(), data.profile());
  EXPECT_EQ(fs::last_write_time(inputs), time_at(2000));
  // A record that is newer than what it was packed from is of another packing.
  fs::last_write_time(shard / "packed.inputs", time_at(1999));
  write_file(inputs, "of a packing that was refused\n");
  write_pack_inputs(data.path(), data.profile());
  EXPECT_NE(fs::last_write_time(inputs), time_at(2000));
}

TEST(PackInputs, SayWhatIsMissing) {
  const PlannedDataset data(2);
  EXPECT_EQ(message_of<UsageError>([&] { write_pack_inputs(data.path(), "none.yaml"); }), "there is no none.yaml");
  EXPECT_EQ(message_of<UsageError>([&] { write_pack_inputs("nowhere", data.profile()); }),
            "there is no nowhere/plan/samples.csv");
  write_file(data / "plan/.lock-plan", "");
  fs::remove(data / "plan/plan.yaml");
  EXPECT_EQ(message_of<DataError>([&] { write_pack_inputs(data.path(), data.profile()); }),
            "the plan of " + data.path().string() +
                " is half replaced; make it again: make -f Makefile.data plan CONFIG=...");
  const PlannedDataset empty(0);
  EXPECT_EQ(message_of<DataError>([&] { write_pack_inputs(empty.path(), empty.profile()); }),
            (empty / "plan/samples.csv").string() + " has no samples");
}

}  // namespace pack_inputs_test
}  // namespace tacipc
