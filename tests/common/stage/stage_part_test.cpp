// Parts of a result that are results of their own.
#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/config/config.h"
#include "common/sample/press_folder.h"
#include "common/stage/stage.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace stage_part_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class PartTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write_file(root_ / "in.txt", "input");
    write_file(root_ / "c.yaml", "force_n: 2\n");
  }
  int run(const std::function<void(Stage&)>& body) {
    std::vector<std::string> words{"press",
                                   "--mesh",
                                   (root_ / "in.txt").string(),
                                   "--config",
                                   (root_ / "c.yaml").string(),
                                   "--out",
                                   (root_ / "out").string(),
                                   "--log-level",
                                   "off"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ::testing::internal::CaptureStderr();
    const int code = run_stage(spec_, static_cast<int>(argv.size()), argv.data(), body);
    ::testing::internal::GetCapturedStderr();
    return code;
  }
  struct Config {
    static Config read(ConfigReader& in) {
      in.number("force_n");
      return {};
    }
  };
  /// One folder for each finger, and a file of both.
  static void two_parts(Stage& stage) {
    stage.read_config<Config>("--config");
    stage.note("sample", "star");
    for (const std::string side : {"left", "right"}) {
      write_file(stage.output(side + "/press/force.txt"), side);
      write_file(stage.output(side + "/press/marks/a.txt"), "a");
      write_file(stage.varying_output(side + "/press/times.txt"), "1");
      stage.finish_part(side + "/press", {{"side", side}});
    }
    write_file(stage.output("left/pressure.txt"), "of no part");
    write_file(stage.output("both.txt"), "both");
    stage.summarize({{"fingers", 2}});
  }
  static std::vector<std::string> outputs_of(const fs::path& record) {
    return ConfigReader::from_file(record).section("outputs").keys();
  }

  StageSpec spec_{.name = "press",
                  .summary = "Presses.",
                  .inputs = {{.flag = "--config", .help = "how"}, {.flag = "--mesh", .help = "what"}}};
  ScratchFolder root_;
};

TEST_F(PartTest, ARecordInTheFolderNamesItsOwnOutputsAlone) {
  ASSERT_EQ(run(two_parts), 0);
  const fs::path left = root_ / "out/left/press";
  EXPECT_THAT(outputs_of(left / "press.yaml"), ElementsAre("force.txt", "marks/a.txt", "times.txt"));
  ConfigReader record = ConfigReader::from_file(left / "press.yaml");
  ConfigReader outputs = record.section("outputs");
  EXPECT_EQ(outputs.text("force.txt"), content_hash(left / "force.txt"));
  EXPECT_EQ(outputs.text("times.txt"), "varies");
  EXPECT_EQ(record.text("sample"), "star");
  const std::string text = read_file(left / "press.yaml");
  EXPECT_THAT(text, HasSubstr("summary:\n  side: left\n"));
  EXPECT_THAT(text, HasSubstr("force_n: 2"));
  EXPECT_THAT(text, Not(HasSubstr("fingers")));
  EXPECT_THAT(read_file(root_ / "out/right/press/press.yaml"), HasSubstr("side: right"));
  // The whole names all of them, the parts' records too.
  const std::vector<std::string> all = outputs_of(root_ / "out/press.yaml");
  EXPECT_EQ(all.size(), 10u);
  ConfigReader whole = ConfigReader::from_file(root_ / "out/press.yaml");
  EXPECT_EQ(whole.section("outputs").text("left/press/press.yaml"), content_hash(left / "press.yaml"));
}

TEST_F(PartTest, PathsOfInputsAreSeenFromTheFolder) {
  ASSERT_EQ(run(two_parts), 0);
  const auto mesh = [&](const std::string& record) {
    ConfigReader in = ConfigReader::from_file(root_ / record);
    ConfigReader inputs = in.section("inputs");
    ConfigReader of_mesh = inputs.section("mesh");
    return std::pair(of_mesh.text("path"), of_mesh.text("hash"));
  };
  const auto [path, hash] = mesh("out/left/press/press.yaml");
  EXPECT_EQ(path, "../../../in.txt");
  EXPECT_TRUE(fs::equivalent(root_ / "out/left/press" / path, root_ / "in.txt"));
  EXPECT_EQ(hash, content_hash(root_ / "in.txt"));
  EXPECT_EQ(mesh("out/press.yaml"), std::pair(std::string("../in.txt"), hash));
}

TEST_F(PartTest, APressFolderIsFinishedByIt) {
  ASSERT_EQ(run([](Stage& stage) {
              const ArrayWriter writer(stage, {{kFrames, 2}}, "left/press/");
              writer.write(PressArray::time, {0.0, 0.5});
              stage.finish_part("left/press", {});
            }),
            0);
  EXPECT_THAT(PressFolder::finished(root_ / "out/left/press").times(), ElementsAre(0.0, 0.5));
  EXPECT_THROW(PressFolder::finished(root_ / "out/right/press"), DataError);
  // And vouched for by it.
  const fs::path time = PressFolder(root_ / "out/left/press").path(PressArray::time);
  std::string bytes = read_file(time);
  bytes.back() ^= 1;
  write_file(time, bytes);
  EXPECT_THROW(PressFolder::finished(root_ / "out/left/press").times(), DataError);
}

TEST_F(PartTest, AStageThatFailsLeavesNoPart) {
  const auto failing = [](Stage& stage) {
    two_parts(stage);
    throw DataError("no more");
  };
  EXPECT_EQ(run(failing), 1);
  EXPECT_FALSE(fs::exists(root_ / "out/left"));
  // Nor that of an earlier run, nor the folders it was in.
  ASSERT_EQ(run(two_parts), 0);
  EXPECT_EQ(run(failing), 1);
  EXPECT_FALSE(fs::exists(root_ / "out/left"));
  EXPECT_FALSE(fs::exists(root_ / "out/right"));
  EXPECT_FALSE(fs::exists(root_ / "out/.partial-press"));
}

/// A run that cannot put all its files in place has published no part, whichever file it was.
TEST_F(PartTest, RecordsOfPartsComeAfterAllOtherFiles) {
  root_.file("out/both.txt/mine.txt", "the user's own");  // in the way of the last file
  EXPECT_EQ(run(two_parts), 1);
  EXPECT_TRUE(fs::exists(root_ / "out/left/press/force.txt"));
  EXPECT_FALSE(fs::exists(root_ / "out/left/press/press.yaml"));
  EXPECT_FALSE(fs::exists(root_ / "out/right/press/press.yaml"));
  EXPECT_FALSE(fs::exists(root_ / "out/press.yaml"));
}

TEST_F(PartTest, ANewRunLeavesNothingOfPartsThatItDoesNotHave) {
  ASSERT_EQ(run(two_parts), 0);
  ASSERT_EQ(run([](Stage& stage) { write_file(stage.output("force.txt"), "one"); }), 0);
  EXPECT_FALSE(fs::exists(root_ / "out/left"));
  EXPECT_THAT(outputs_of(root_ / "out/press.yaml"), ElementsAre("force.txt"));
}

}  // namespace stage_part_test
}  // namespace tacipc
