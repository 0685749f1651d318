// The program on shards that pack made of samples of which every number is known.
#include <gmock/gmock.h>

#include "common/base/sha256.h"
#include "common/format/hdf5_reader.h"
#include "tests/program_test.h"
#include "tests/stages/dataset/pack/sample_files.h"

namespace tacipc {
namespace card_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kTrain = "train-00000-of-00001";
constexpr const char* kVal = "val-00000-of-00001";

class CardTest : public ProgramTest {
 protected:
  void SetUp() override {
    for (const std::string id : {"toy__cube__press__000000", "toy__cube__press__000002"})
      MadeSample(scratch_, "data/samples/000/" + id);
    scratch_.file("data/samples/000/toy__cone__press__000001/press/press.failed.yaml",
                  "stage: press\nmessage: \"no, at last\"\nframe: 1\n");
    plan_ =
        kPlanHeader + row(0, "train", "cube", kTrain) + row(1, "train", "cone", kTrain) + row(2, "val", "cube", kVal);
    scratch_.file("data/plan/samples.csv", plan_);
    scratch_.file("data/plan/dataset.yaml", "name: test\n");
    scratch_.file("pack.yaml", "obs: {rgb: true, indentation_mm: true}\n");
    scratch_.file("card.yaml", "purpose: To be tested.\nlicence: none but ours\nnotes: A note.\n");
    scratch_.file("loader.py", "print('loads')\n");
    scratch_.file("check_labels.py", "print('checks')\n");
    pack(kTrain);
    pack(kVal);
  }
  static std::string row(int index, const std::string& split, const std::string& object, const std::string& shard) {
    const std::string id = fmt::format("toy__{}__press__{:06}", object, index);
    return fmt::format("{},{},{},test,7,toy,tiny,{},press,{},samples/000/{}\n", id, index, split, object, shard, id);
  }
  void pack(const std::string& shard) {
    ASSERT_EQ(
        run_command(fmt::format("cd {} && {}/pack --config pack.yaml --plan data/plan/samples.csv --shard {} --out "
                                "shards/{} --log-level error",
                                (scratch_ / "").string(), TACIPC_BIN_DIR, shard, shard)),
        0)
        << said_;
  }
  int card(const std::string& shards = "shards/*/pack.yaml") {
    list(shards);
    return run_command(
        fmt::format("cd {} && {}/card --config card.yaml --plan data/plan/samples.csv --dataset "
                    "data/plan/dataset.yaml --shards shards.txt --loader loader.py --check-labels check_labels.py "
                    "--name toys --out out --log-level "
                    "error",
                    (scratch_ / "").string(), TACIPC_BIN_DIR));
  }
  void list(const std::string& shards) {
    ASSERT_EQ(run_command(fmt::format("cd {} && printf '%s\\n' {} > shards.txt", (scratch_ / "").string(), shards)), 0);
  }
  std::string text(const std::string& name) { return read_file(scratch_ / ("out/" + name)); }

  std::string plan_;
};

TEST_F(CardTest, TablesAndSplitsFollowThePlan) {
  ASSERT_EQ(card(), 0) << said_;
  const std::string manifest = text("manifest.csv");
  const auto first = manifest.find("\ntoy__cube__press__000000,"),
             second = manifest.find("\ntoy__cone__press__000001,"),
             third = manifest.find("\ntoy__cube__press__000002,");
  EXPECT_TRUE(first < second && second < third && third != std::string::npos) << manifest;
  EXPECT_EQ(text("failures.csv"),
            "id,stage,reason,frame,check,value,limit,log\ntoy__cone__press__000001,press,\"no, at "
            "last\",1,,,,samples/000/toy__cone__press__000001/press/press.log\n");
  EXPECT_EQ(text("splits/train.txt"), "toy__cube__press__000000\n");
  EXPECT_EQ(text("splits/val.txt"), "toy__cube__press__000002\n");
  EXPECT_EQ(text("splits/test.txt"), "");
  EXPECT_EQ(text("splits/pose/test.txt"), "toy__cube__press__000000\ntoy__cube__press__000002\n");
}

TEST_F(CardTest, ThereMayBeMoreShardsThanFilesThatAProcessOpens) {
  plan_ = kPlanHeader;
  std::vector<std::string> shards;
  for (int i = 0; i < 12; ++i) {
    shards.push_back(fmt::format("train-{:05}-of-00012", i));
    for (const int index : {2 * i, 2 * i + 1}) {
      plan_ += row(index, "train", "ball", shards.back());
      scratch_.file(fmt::format("data/samples/000/toy__ball__press__{:06}/press/press.failed.yaml", index),
                    "stage: press\nmessage: no\n");
    }
  }
  scratch_.file("data/plan/samples.csv", plan_);
  std::filesystem::remove_all(scratch_ / "shards");
  for (const std::string& shard : shards) pack(shard);
  list("shards/*/pack.yaml");
  ASSERT_EQ(
      run_command(fmt::format(
          "cd {} && ulimit -n 36 && {}/card --config card.yaml --plan data/plan/samples.csv "
          "--dataset data/plan/dataset.yaml --shards shards.txt --loader loader.py --check-labels check_labels.py "
          "--out out --threads 1 --log-level error",
          (scratch_ / "").string(), TACIPC_BIN_DIR)),
      0)
      << said_;
  const std::string failures = text("failures.csv");
  EXPECT_EQ(std::count(failures.begin(), failures.end(), '\n'), 25);
}

TEST_F(CardTest, EveryFileHasItsChecksumButTheTimes) {
  ASSERT_EQ(card(), 0) << said_;
  const std::string sums = text("checksums.sha256");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch_ / "out")) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().lexically_relative(scratch_ / "out").generic_string();
    const bool without =
        name.starts_with("card.") || name.starts_with(".lock") || name == "timings.csv" || name == "checksums.sha256";
    const std::string line = fmt::format("{}  {}\n", sha256_of_file(entry.path()), name);
    EXPECT_EQ(sums.find(line) == std::string::npos, without) << name;
  }
  EXPECT_TRUE(std::filesystem::equivalent(scratch_ / fmt::format("out/shards/{}.h5", kVal),
                                          scratch_ / fmt::format("shards/{}/{}.h5", kVal, kVal)));
}

TEST_F(CardTest, TheCardTellsWhatIsInTheDataAndWhatIsNot) {
  ASSERT_EQ(card(), 0) << said_;
  const std::string readme = text("README.md");
  EXPECT_THAT(
      readme,
      AllOf(HasSubstr("# toys\n\nTo be tested.\n"), HasSubstr("| Samples | 2 |"), HasSubstr("| Frames | 4 |"),
            HasSubstr("| train | 1 | 1 |\n| val | 1 | 0 |\n| test | 0 | 0 |"), HasSubstr("(1 failed, 0 never tried)"),
            HasSubstr("print('loads')"), HasSubstr("| `balance_relative` | 0.001 | contact, inertia"),
            HasSubstr("none but ours"), HasSubstr("A note.")));
  EXPECT_THAT(readme, HasSubstr("| `obs/indentation_mm` | float32 | (T,H,W) | mm | S | undeformed minus deformed"));
  EXPECT_EQ(readme.find("obs/normal"), std::string::npos);
  EXPECT_THAT(text("sensors/toy/camera.json"), HasSubstr("\"K\": [[2.5, 0.0, 2.0], [0.0, 2.5, 1.5], [0.0, 0.0, 1.0]]"));
  EXPECT_EQ(text("objects/cube/object.ply"), "the object\n");
}

TEST_F(CardTest, ShardsMustBeThoseOfThePlan) {
  EXPECT_EQ(card(fmt::format("shards/{}/pack.yaml", kTrain)), 1);
  EXPECT_THAT(said_, HasSubstr("shard val-00000-of-00001 has not been packed"));
  EXPECT_EQ(card(fmt::format("shards/{}/pack.yaml shards/{}/pack.yaml shards/{}/pack.yaml", kTrain, kVal, kVal)), 1);
  EXPECT_THAT(said_, HasSubstr("shard val-00000-of-00001 is given twice"));
  scratch_.file("data/plan/samples.csv", plan_.substr(0, plan_.find("toy__cube__press__000002")));
  EXPECT_EQ(card(), 1);
  EXPECT_THAT(said_, HasSubstr("has no shard val-00000-of-00001, which was packed"));
  scratch_.file("data/plan/samples.csv", kPlanHeader + row(3, "train", "cube", kTrain) + row(2, "val", "cube", kVal));
  EXPECT_EQ(card(), 1);
  EXPECT_THAT(said_, HasSubstr("is of another plan: expected toy__cube__press__000003 next"));
}

TEST_F(CardTest, RowsOfThePlanMustHoldWhatTheirColumnsSay) {
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& message) {
    std::string plan = plan_;
    const std::size_t at = plan.find(from, plan.find('\n'));
    ASSERT_NE(at, std::string::npos) << from;
    scratch_.file("data/plan/samples.csv", plan.replace(at, from.size(), to));
    EXPECT_EQ(card(), 1) << to;
    EXPECT_THAT(said_, HasSubstr("data/plan/samples.csv:2: " + message)) << to;
  };
  for (const char* seed : {"#", "-1", "inf", "", "1.5", "18446744073709551616"})
    refused(",test,7,", fmt::format(",test,{},", seed),
            fmt::format("'{}' is not a seed, a whole number from 0 to 2^64 - 1", seed));
  refused("000000,0,train", "000000,first,train", "'first' is not an index, a whole number from 0");
  refused("samples/000/", "../samples/000/", "'../samples/000/toy__cube__press__000000' is not a folder below");
  refused("samples/000/", "/", "'/toy__cube__press__000000' is not a folder below");
}

TEST_F(CardTest, TheListNamesShardsThatAreThere) {
  EXPECT_EQ(card(fmt::format("shards/{}/pack.yaml shards/gone/pack.yaml", kTrain)), 1);
  EXPECT_THAT(said_, HasSubstr("shards/gone/pack.yaml has not been packed: there is no shards/gone/pack.yaml"));
  EXPECT_EQ(card("''"), 1);
  EXPECT_THAT(said_, HasSubstr("shards.txt: names no shard"));
  ASSERT_EQ(card(), 0) << said_;
  EXPECT_THAT(text("card.yaml"),
              HasSubstr(fmt::format("  shards/{}:\n    path: ../shards/{}/pack.yaml\n", kVal, kVal)));
}

TEST_F(CardTest, ARefusedCardLeavesWhatUsersDownload) {
  ASSERT_EQ(card(), 0) << said_;
  const std::string before = content_hash(scratch_ / "out");
  std::filesystem::remove(scratch_ / "made_from/object.ply");
  EXPECT_EQ(card(), 1);
  EXPECT_THAT(said_, HasSubstr("object.ply: has changed or been removed since the samples were made from it"));
  std::filesystem::remove(scratch_ / "out/card.failed.yaml");
  EXPECT_EQ(content_hash(scratch_ / "out"), before);
}

TEST_F(CardTest, ADamagedShardIsNotGivenAway) {
  ASSERT_EQ(card(), 0) << said_;
  const std::string before = content_hash(scratch_ / "out");
  const auto refused = [&](const std::string& reason) {
    EXPECT_EQ(card(), 1);
    EXPECT_THAT(said_, HasSubstr(fmt::format("shards/{0}/{0}.h5: {1}", kVal, reason)));
    std::filesystem::remove(scratch_ / "out/card.failed.yaml");
    EXPECT_EQ(content_hash(scratch_ / "out"), before);
  };
  const std::string shard = fmt::format("shards/{0}/{0}.h5", kVal), bytes = read_file(scratch_ / shard);
  const auto replace = [&](const std::string& by) {
    std::filesystem::remove(scratch_ / shard);  // the card's is a link to it
    scratch_.file(shard, by);
  };
  replace(bytes.substr(0, bytes.size() / 2));
  refused("is damaged, or not the file that ");
  std::string flipped = bytes;
  flipped[bytes.size() / 2] ^= 1;
  replace(flipped);
  refused("is damaged, or not the file that ");
  // Whole, but not what was packed.
  const std::string digest = read_file(scratch_ / (shard + ".sha256"));
  scratch_.file(shard + ".sha256", fmt::format("{}  {}.h5\n", sha256(flipped), kVal));
  refused("is not the file that pack.yaml beside it describes");
  std::filesystem::remove(scratch_ / (shard + ".sha256"));
  replace(bytes);
  refused("there is no ");
  scratch_.file(shard + ".sha256", digest);
  EXPECT_EQ(card(), 0) << said_;
}

TEST_F(CardTest, ShardsMustHaveTheSameFieldsAndFiles) {
  scratch_.file("pack.yaml", "obs: {rgb: true}\n");
  pack(kVal);
  EXPECT_EQ(card(), 1);
  EXPECT_THAT(said_, HasSubstr("packed with other fields than"));
  pack(kTrain);
  ASSERT_EQ(card(), 0) << said_;
  scratch_.file("made_from/object.ply", "another object\n");
  EXPECT_EQ(card(), 1);
  EXPECT_THAT(said_, HasSubstr("object.ply: has changed or been removed since the samples were made from it"));
}

}  // namespace card_test
}  // namespace tacipc
