#include "common/stage/stage.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace stage_test {

namespace fs = std::filesystem;

class StageTest : public ::testing::Test {
 protected:
  void SetUp() override { write_file(root_ / "in.txt", "input"); }

  int run(const std::function<void(Stage&)>& body, std::vector<std::string> more = {}) {
    std::vector<std::string> words{
        "copy", "--mesh", (root_ / "in.txt").string(), "--out", (root_ / "out").string(), "--log-level", "off"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ::testing::internal::CaptureStderr();
    const int code = run_stage(spec_, static_cast<int>(argv.size()), argv.data(), body);
    said_ = ::testing::internal::GetCapturedStderr();
    return code;
  }

  StageSpec spec_{.name = "copy", .summary = "Copies.", .inputs = {{.flag = "--mesh", .help = "what to copy"}}};
  ScratchFolder root_;
  std::string said_;
};

TEST_F(StageTest, SuccessPublishesOutputsAndARecordWithoutTimes) {
  const auto body = [](Stage& stage) {
    write_file(stage.output("a/copy.txt"), read_file(stage.input("--mesh")));
    stage.note("sample", "star");
    stage.summarize({{"bytes", 5}});
  };
  ASSERT_EQ(run(body, {"--threads", "1"}), 0);
  EXPECT_EQ(read_file(root_ / "out/a/copy.txt"), "input");
  const std::string first = read_file(root_ / "out/copy.yaml");
  EXPECT_THAT(first, ::testing::HasSubstr("path: ../in.txt"));
  EXPECT_THAT(first, ::testing::HasSubstr("sample: star"));
  EXPECT_THAT(first, ::testing::HasSubstr("bytes: 5"));
  EXPECT_FALSE(fs::exists(root_ / "out/.partial-copy"));
  ASSERT_EQ(run(body, {"--threads", "2"}), 0);
  EXPECT_EQ(read_file(root_ / "out/copy.yaml"), first);
}

// Content alone tells: dates, links and copies do not.
TEST_F(StageTest, IfChangedRunsForOtherContentAlone) {
  int runs = 0;
  spec_.inputs.push_back({.flag = "--other", .help = "too", .required = false});
  spec_.options.push_back({.flag = "--name", .help = "of it", .fallback = ""});
  const auto body = [&](Stage& stage) {
    ++runs;
    stage.add_input("named", root_ / "named.txt");
    write_file(stage.output("copy.txt"), read_file(stage.input("--mesh")));
  };
  write_file(root_ / "named.txt", "by a configuration");
  const auto again = [&](std::vector<std::string> more = {}) {
    more.emplace_back("--if-changed");
    return run(body, more);
  };
  EXPECT_EQ(again(), 0);
  EXPECT_EQ(again(), 3);
  fs::last_write_time(root_ / "in.txt", fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_EQ(again(), 3) << "a later date";
  fs::rename(root_ / "in.txt", root_ / "elsewhere.txt");
  fs::create_symlink(root_ / "elsewhere.txt", root_ / "in.txt");
  EXPECT_EQ(again(), 3) << "a link to the same content";
  EXPECT_EQ(runs, 1);
  write_file(root_ / "elsewhere.txt", "longer");
  fs::last_write_time(root_ / "elsewhere.txt", fs::file_time_type::clock::now() - std::chrono::hours(9999));
  EXPECT_EQ(again(), 0) << "another content of an earlier date";
  EXPECT_EQ(read_file(root_ / "out/copy.txt"), "longer");
  write_file(root_ / "named.txt", "by another");
  EXPECT_EQ(again(), 0) << "a file that no flag names";
  EXPECT_EQ(again({"--name", "star"}), 0) << "another option";
  EXPECT_EQ(again({"--name", "star", "--other", (root_ / "named.txt").string()}), 0) << "another input";
  EXPECT_EQ(again({"--name", "star"}), 0) << "an input less";
  EXPECT_EQ(again({"--name", "star"}), 3);
  fs::remove(root_ / "out/copy.txt");
  EXPECT_EQ(again({"--name", "star"}), 0) << "an output that is gone";
  EXPECT_EQ(run(body, {"--name", "star"}), 0) << "not asked";
  EXPECT_EQ(runs, 8);
}

TEST_F(StageTest, AFolderThatHoldsTheResultsIsReadWithoutThem) {
  spec_.inputs = {{.flag = "--mesh", .help = "a folder"}};
  int runs = 0;
  const auto again = [&] {
    std::vector<std::string> words{
        "copy", "--mesh",      (root_ / "all").string(), "--out", (root_ / "all/out").string(), "--log-level",
        "off",  "--if-changed"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    return run_stage(spec_, static_cast<int>(argv.size()), argv.data(), [&](Stage& stage) {
      ++runs;
      write_file(stage.output("copy.txt"), "copy");
    });
  };
  write_file(root_ / "all/press/one.txt", "one");
  EXPECT_EQ(again(), 0);
  EXPECT_EQ(again(), 3);
  write_file(root_ / "all/press/two.txt", "two");
  EXPECT_EQ(again(), 0);
  EXPECT_EQ(runs, 2);
}

TEST_F(StageTest, FailureLeavesNoRecordAndNoOutput) {
  ASSERT_EQ(run([](Stage& stage) { write_file(stage.output("copy.txt"), "old"); }), 0);
  EXPECT_EQ(run([](Stage& stage) {
              write_file(stage.output("half.txt"), "half");
              throw DataError("{}: {} is not a mesh", "in.txt", 3);
            }),
            1);
  EXPECT_EQ(said_, "copy: error: in.txt: 3 is not a mesh\n");
  EXPECT_FALSE(fs::exists(root_ / "out/copy.yaml"));
  EXPECT_FALSE(fs::exists(root_ / "out/half.txt"));
}

TEST_F(StageTest, WrongFlagsAndConfigurationsEndWithTwo) {
  EXPECT_EQ(run([](Stage&) {}, {"--depth", "3"}), 2);
  EXPECT_EQ(run([](Stage&) { throw ConfigError({"a.yaml:1:1: x: missing"}); }), 2);
  EXPECT_EQ(said_, "a.yaml:1:1: x: missing\n");
}

TEST_F(StageTest, APipeAsInputIsRefusedInsteadOfWaitedFor) {
  const fs::path pipe = root_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  spec_.inputs.push_back({.flag = "--other", .help = "too", .required = false});
  EXPECT_EQ(run([](Stage&) {}, {"--other", pipe.string()}), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr(pipe.string() + " is a pipe or a device, expected a file or folder"));
  EXPECT_EQ(message_of<DataError>([&] { read_file(pipe); }),
            pipe.string() + ": is a pipe or a device, expected a file");
  EXPECT_EQ(message_of<DataError>([&] { content_hash("/dev/zero"); }),
            "/dev/zero: is a pipe or a device, expected a file");
}

TEST_F(StageTest, ANameThatIsNotUtf8IsRefusedAsNoRecordCanHoldIt) {
  spec_.inputs.push_back({.flag = "--other", .help = "too", .required = false});
  const std::string name = (root_ / "caf\xe9.txt").string();
  write_file(name, "latin");
  EXPECT_EQ(run([](Stage&) {}, {"--other", name}), 2);
  EXPECT_EQ(said_, "copy: error: ../caf\\xe9.txt: its name is not UTF-8; rename or link it\n");
  EXPECT_FALSE(fs::exists(root_ / "out/copy.yaml"));
  // What failed because of such a name leaves a file that can be read.
  EXPECT_EQ(run([&](Stage&) { throw DataError(name + ": \x1b[31m"); }), 1);
  EXPECT_THAT(ConfigReader::from_file(root_ / "out/copy.failed.yaml").text("message"),
              ::testing::EndsWith("caf\\xe9.txt: \\x1b[31m"));
}

TEST_F(StageTest, FaultsOfTheFileSystemBeginWithThePath) {
  const fs::path name = root_ / std::string(300, 'n');
  EXPECT_EQ(run([&](Stage&) { static_cast<void>(fs::exists(name / "below")); }), 1);
  EXPECT_EQ(said_, "copy: error: " + (name / "below").string() + ": File name too long\n");
}

TEST_F(StageTest, NamedPathsKeepTheirNamesAndOrder) {
  spec_.inputs.push_back({.flag = "--pictures", .help = "of methods", .required = false, .many = true, .named = true});
  std::vector<NamedPath> given;
  const auto body = [&](Stage& stage) { given = stage.named_inputs("--pictures"); };
  ASSERT_EQ(run(body), 0);
  EXPECT_TRUE(given.empty());
  EXPECT_THAT(read_file(root_ / "out/copy.yaml"), ::testing::Not(::testing::HasSubstr("pictures")));
  write_file(root_ / "a=b.txt", "another");
  const std::string one = (root_ / "in.txt").string(), other = (root_ / "a=b.txt").string();
  ASSERT_EQ(run(body, {"--pictures", "ours=" + other, "real=" + one, "ours=" + one}), 0);
  ASSERT_EQ(given.size(), 3u);
  EXPECT_EQ(given[0].name, "ours");
  EXPECT_EQ(given[0].path, other);
  EXPECT_EQ(given[1].name, "real");
  EXPECT_EQ(given[2].path, one);
  EXPECT_THAT(read_file(root_ / "out/copy.yaml"), ::testing::HasSubstr("- name: ours\n      path: ../a=b.txt"));
  EXPECT_EQ(run(body, {"--pictures", one}), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("--pictures: '" + one + "' is not NAME=PATH"));
  EXPECT_EQ(run(body, {"--pictures", "ours=no_such_file"}), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("no_such_file"));
}

TEST_F(StageTest, UnwritableFolderIsOneMessage) {
  write_file(root_ / "out", "a file where the folder should be");
  EXPECT_EQ(run([](Stage&) {}), 1);
  EXPECT_THAT(said_, ::testing::HasSubstr("copy: error: "));
}

TEST_F(StageTest, WhatAnEarlierRunLeftGoesWithItsRecord) {
  ASSERT_EQ(run([](Stage& stage) {
              write_file(stage.output("frame_1/a.txt"), "1");
              write_file(stage.output("frame_2/a.txt"), "2");
            }),
            0);
  write_file(root_ / "out/frame_2/mine.txt", "the user's own");
  ASSERT_EQ(run([](Stage& stage) { write_file(stage.output("frame_3/a.txt"), "3"); }), 0);
  EXPECT_FALSE(fs::exists(root_ / "out/frame_1"));
  EXPECT_FALSE(fs::exists(root_ / "out/frame_2/a.txt"));
  EXPECT_TRUE(fs::exists(root_ / "out/frame_2/mine.txt"));
  EXPECT_TRUE(fs::exists(root_ / "out/frame_3/a.txt"));
}

/// Of a stage that others go on reading while it makes its results anew.
class KeepingStageTest : public StageTest {
 protected:
  void SetUp() override {
    StageTest::SetUp();
    spec_.keeps_old_until_done = true;
    ASSERT_EQ(make("one", {"a/both.txt", "a/old.txt", "gone/old.txt"}), 0);
    first_ = whole();
  }
  int make(const std::string& content, const std::vector<std::string>& names) {
    return run([&](Stage& stage) {
      for (const std::string& name : names) write_file(stage.output(name), content);
    });
  }
  /// Every file but log and lock, with its bytes.
  std::map<std::string, std::string> whole() {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(root_ / "out")) {
      const std::string name = entry.path().lexically_relative(root_ / "out").generic_string();
      if (entry.is_regular_file() && name != "copy.log" && name != ".lock-copy") files[name] = read_file(entry.path());
    }
    return files;
  }

  std::map<std::string, std::string> first_;
};

TEST_F(KeepingStageTest, WhatWasThereStaysWhileAnotherIsMadeAndWhereItIsRefused) {
  EXPECT_EQ(run([&](Stage& stage) {
              write_file(stage.output("a/both.txt"), "two");
              std::map<std::string, std::string> meanwhile = whole();
              EXPECT_EQ(meanwhile.erase(".partial-copy/a/both.txt"), 1u);
              EXPECT_EQ(meanwhile, first_);
              throw ConfigError({"a.yaml:1:1: x: missing"});
            }),
            2);
  EXPECT_EQ(whole(), first_);
  EXPECT_EQ(run([&](Stage& stage) {
              write_file(stage.output("a/both.txt"), "two");
              throw DataError("no more");
            }),
            1);
  std::map<std::string, std::string> then = whole();
  EXPECT_EQ(then.erase("copy.failed.yaml"), 1u);
  EXPECT_EQ(then, first_);
  EXPECT_EQ(run([&](Stage& stage) {
              write_file(stage.output("a/both.txt"), "two");
              write_file(root_ / "in.txt", "edited");
            }),
            1);
  then = whole();
  EXPECT_EQ(then.erase("copy.failed.yaml"), 1u);
  EXPECT_EQ(then, first_);
}

TEST_F(KeepingStageTest, TheNewResultIsAllThatIsLeft) {
  ASSERT_EQ(make("two", {"a/both.txt", "new.txt"}), 0);
  std::map<std::string, std::string> files = whole();
  EXPECT_NE(files["copy.yaml"], first_["copy.yaml"]);
  EXPECT_EQ(files.erase("copy.yaml") + files.erase("copy.timings.yaml"), 2u);
  EXPECT_EQ(files, (std::map<std::string, std::string>{{"a/both.txt", "two"}, {"new.txt", "two"}}));
  EXPECT_FALSE(fs::exists(root_ / "out/gone"));
}

TEST_F(KeepingStageTest, AMixtureOfOldAndNewHasNoRecordAndIsNotForgotten) {
  // A folder with something in it stands in the way of the second file.
  fs::remove(root_ / "out/a/old.txt");
  root_.file("out/a/old.txt/mine.txt", "the user's own");
  ASSERT_EQ(make("two", {"a/both.txt", "a/old.txt", "new.txt"}), 1);
  EXPECT_EQ(read_file(root_ / "out/a/both.txt"), "two");
  EXPECT_EQ(read_file(root_ / "out/gone/old.txt"), "one");
  EXPECT_FALSE(fs::exists(root_ / "out/copy.yaml"));
  // Files of both runs before are known to the next.
  fs::remove_all(root_ / "out/a/old.txt");
  ASSERT_EQ(make("three", {"third.txt"}), 0);
  std::map<std::string, std::string> files = whole();
  EXPECT_EQ(files.erase("copy.yaml") + files.erase("copy.timings.yaml"), 2u);
  EXPECT_EQ(files, (std::map<std::string, std::string>{{"third.txt", "three"}}));
}

TEST_F(KeepingStageTest, WhatABodyChangesBesideItsOutputsTakesTheRecordAway) {
  EXPECT_EQ(run([&](Stage& stage) {
              stage.retire_old_record();
              EXPECT_FALSE(fs::exists(root_ / "out/copy.yaml"));
              EXPECT_EQ(read_file(root_ / "out/a/old.txt"), "one");
              throw DataError("killed");
            }),
            1);
  EXPECT_FALSE(fs::exists(root_ / "out/copy.yaml"));
  ASSERT_EQ(make("two", {"new.txt"}), 0);
  EXPECT_FALSE(fs::exists(root_ / "out/a"));
}

TEST_F(StageTest, AnInputThatChangesMeanwhileIsAFailure) {
  EXPECT_EQ(run([&](Stage& stage) {
              write_file(stage.output("copy.txt"), read_file(stage.input("--mesh")));
              write_file(root_ / "in.txt", "edited");
            }),
            1);
  EXPECT_EQ(said_, "copy: error: an input changed while the stage ran; run it again\n");
  EXPECT_FALSE(fs::exists(root_ / "out/copy.txt"));
}

TEST_F(StageTest, FailedWorkLeavesItsReasonUntilTheNextStart) {
  spec_.options = {{.flag = "--name", .help = "the sample's name", .fallback = "sample"}};
  EXPECT_EQ(run([](Stage&) { throw DataError("in.txt: 3 is: no mesh"); }, {"--name", "star"}), 1);
  EXPECT_EQ(read_file(root_ / "out/copy.failed.yaml"),
            "stage: copy\nversion: " + program_version() + "\nname: star\nmessage: \"in.txt: 3 is: no mesh\"\n");
  EXPECT_FALSE(fs::exists(root_ / "out/copy.yaml"));
  // Wrong flags are no start; a wrong configuration is one, but no failure of the work.
  EXPECT_EQ(run([](Stage&) {}, {"--depth", "3"}), 2);
  EXPECT_TRUE(fs::exists(root_ / "out/copy.failed.yaml"));
  EXPECT_EQ(run([](Stage&) { throw ConfigError({"a.yaml:1:1: x: missing"}); }), 2);
  EXPECT_FALSE(fs::exists(root_ / "out/copy.failed.yaml"));
  EXPECT_EQ(run([](Stage&) { throw std::bad_alloc(); }), 1);
  EXPECT_THAT(read_file(root_ / "out/copy.failed.yaml"), ::testing::EndsWith("\nmessage: out of memory\n"));
  EXPECT_EQ(run([](Stage&) {}), 0);
  EXPECT_FALSE(fs::exists(root_ / "out/copy.failed.yaml"));
}

TEST_F(StageTest, AFrameThatMissesALimitLeavesTheNumbers) {
  EXPECT_EQ(run([](Stage& stage) {
              stage.note("sample", "star");
              throw VerdictError({.frame = 7, .check = "balance", .value = 0.0021, .limit = 1e-3}, "frame 7: off");
            }),
            1);
  EXPECT_EQ(said_, "copy: error: frame 7: off\n");
  EXPECT_THAT(read_file(root_ / "out/copy.failed.yaml"),
              ::testing::EndsWith(
                  "sample: star\nmessage: \"frame 7: off\"\nframe: 7\ncheck: balance\nvalue: 0.0021\nlimit: 0.001\n"));
}

TEST_F(StageTest, AFailureFileThatCannotBeWrittenIsNotASecondMessage) {
  fs::create_directories(root_ / "out/.failed-copy");
  EXPECT_EQ(run([](Stage&) { throw DataError("no mesh"); }), 1);
  EXPECT_EQ(said_, "copy: error: no mesh\n");
}

TEST(ContentHash, OfAFolderLeavesOutLogsAndHiddenFilesAtAnyDepth) {
  const ScratchFolder scratch;
  scratch.file("a/b.txt", "1");
  const std::string before = content_hash(scratch / "a");
  scratch.file("a/x.log", "2");
  scratch.file("a/.partial-press/b.txt", "3");
  scratch.file("a/c/.partial-press/b.txt", "4");
  EXPECT_EQ(content_hash(scratch / "a"), before);
  scratch.file("a/c/b.txt", "5");
  EXPECT_NE(content_hash(scratch / "a"), before);
}

TEST(WriteFile, FullDiskIsAnError) {
  EXPECT_THROW(
      {
        try {
          write_file("/dev/full", "bytes");
        } catch (const DataError& error) {
          EXPECT_STREQ(error.what(), "/dev/full: cannot be written: No space left on device");
          throw;
        }
      },
      DataError);
}

TEST_F(StageTest, VaryingOutputsStandInTheRecordWithoutAHash) {
  int seconds = 0;
  const auto body = [&](Stage& stage) { write_file(stage.varying_output("times.csv"), std::to_string(++seconds)); };
  ASSERT_EQ(run(body), 0);
  const std::string record = read_file(root_ / "out/copy.yaml");
  EXPECT_THAT(record, ::testing::HasSubstr("outputs:\n  times.csv: varies\n"));
  ASSERT_EQ(run(body), 0);
  EXPECT_EQ(read_file(root_ / "out/times.csv"), "2");
  EXPECT_EQ(read_file(root_ / "out/copy.yaml"), record);
}

TEST_F(StageTest, LinkedOutputsShareTheFileAndOutliveIts) {
  const fs::path big = root_.file("other/big.bin", "large");
  const auto body = [&](Stage& stage) { stage.link_output("shards/big.bin", big, "its hash"); };
  ASSERT_EQ(run(body), 0);
  EXPECT_TRUE(fs::equivalent(big, root_ / "out/shards/big.bin"));
  EXPECT_THAT(read_file(root_ / "out/copy.yaml"), ::testing::HasSubstr("shards/big.bin: its hash\n"));
  // A stage never changes a file in place, so the link keeps what it was.
  fs::remove(big);
  EXPECT_EQ(read_file(root_ / "out/shards/big.bin"), "large");
  ASSERT_EQ(run(body), 1);
}

TEST_F(StageTest, InputsAddedTogetherAreInTheRecord) {
  ASSERT_EQ(run([&](Stage& stage) {
              stage.add_inputs({{"one", root_.file("1.txt", "1")}, {"two", root_.file("2.txt", "2")}});
            }),
            0);
  EXPECT_THAT(read_file(root_ / "out/copy.yaml"),
              ::testing::AllOf(::testing::HasSubstr("  one:\n    path: ../1.txt\n"),
                               ::testing::HasSubstr("  two:\n    path: ../2.txt\n")));
}

}  // namespace stage_test
}  // namespace tacipc
