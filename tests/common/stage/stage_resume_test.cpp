// Stages that are killed or fail on the way and go on where they stopped.
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/stage/stage.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace stage_resume_test {

namespace fs = std::filesystem;

/// A stage of five frames. Each holds the input's text and a count of all frames solved, which a resumed run must not
/// begin anew.
class ResumeTest : public ::testing::Test {
 protected:
  static constexpr int kFrames = 5;

  void SetUp() override { write_file(root_ / "in.txt", "a"); }

  int run(std::function<void(int)> before_frame, std::vector<std::string> more = {}) {
    std::vector<std::string> words{
        "count", "--mesh", (root_ / "in.txt").string(), "--out", (root_ / "out").string(), "--log-level", "off"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    solved_ = 0;
    return run_stage(spec_, static_cast<int>(argv.size()), argv.data(), [&](Stage& stage) {
      const std::string text = read_file(stage.input("--mesh"));
      for (const char* added : added_) stage.add_input(added, root_ / added);
      write_file(stage.output("half.txt"), "half");
      std::string all;
      for (int frame = 0; frame < kFrames; ++frame) {
        const std::string name = fmt::format("frame_{}", frame);
        if (const auto saved = stage.load_scratch(name)) {
          all += *saved;
          continue;
        }
        before_frame(frame);
        ++solved_;
        const std::string bytes = fmt::format("{}{}", text, frame);
        stage.save_scratch(name, bytes);
        all += bytes;
      }
      write_file(stage.output("all.txt"), all);
    });
  }

  /// The run in a process of its own that dies by SIGKILL before a frame.
  void run_killed_before(int frame) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      run([&](int at) {
        if (at == frame) ::raise(SIGKILL);
      });
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  }

  static void nothing(int) {}

  fs::path partial() const { return root_ / "out/.partial-count"; }

  StageSpec spec_{.name = "count",
                  .summary = "Counts.",
                  .inputs = {{.flag = "--mesh", .help = "what to repeat"}},
                  .options = {{.flag = "--name", .help = "the sample's name", .fallback = "sample"}},
                  .resumable = true};
  ScratchFolder root_;
  std::vector<const char*> added_ = {};  // inputs that no flag names
  int solved_ = 0;
};

TEST_F(ResumeTest, AKilledRunGoesOnAndEndsInTheSameBytes) {
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, kFrames);
  EXPECT_FALSE(fs::exists(partial()));
  const std::string record = read_file(root_ / "out/count.yaml");

  run_killed_before(3);
  EXPECT_FALSE(fs::exists(root_ / "out/count.yaml"));
  EXPECT_FALSE(fs::exists(root_ / "out/all.txt"));
  EXPECT_TRUE(fs::exists(partial() / "half.txt"));
  ASSERT_EQ(run(nothing, {"--threads", "1"}), 0);
  EXPECT_EQ(solved_, 2);
  EXPECT_EQ(read_file(root_ / "out/all.txt"), "a0a1a2a3a4");
  EXPECT_EQ(read_file(root_ / "out/count.yaml"), record);
  EXPECT_FALSE(fs::exists(partial()));
}

TEST_F(ResumeTest, AFailedFrameLeavesThoseBeforeIt) {
  ASSERT_EQ(run([](int frame) {
              if (frame == 2) throw VerdictError({.frame = frame, .check = "balance"}, "frame 2: off");
            }),
            1);
  EXPECT_TRUE(fs::exists(root_ / "out/count.failed.yaml"));
  EXPECT_FALSE(fs::exists(partial() / "half.txt"));
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, 3);
  EXPECT_FALSE(fs::exists(root_ / "out/count.failed.yaml"));
}

TEST_F(ResumeTest, AFailureBeforeTheFirstFrameLeavesNothingBehind) {
  ASSERT_EQ(run([](int) { throw DataError("no mesh"); }), 1);
  EXPECT_FALSE(fs::exists(partial()));
}

TEST_F(ResumeTest, AnotherInputOrOptionBeginsAnew) {
  run_killed_before(3);
  ASSERT_EQ(run(nothing, {"--name", "star"}), 0);
  EXPECT_EQ(solved_, kFrames);
  run_killed_before(3);
  write_file(root_ / "in.txt", "b");
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, kFrames);
  EXPECT_EQ(read_file(root_ / "out/all.txt"), "b0b1b2b3b4");
}

TEST_F(ResumeTest, AddedInputsArePartOfWhatIsEqual) {
  added_ = {"one.txt", "two.txt"};
  for (const char* added : added_) write_file(root_ / added, "1");
  run_killed_before(3);
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, 2);
  run_killed_before(3);
  write_file(root_ / "two.txt", "2");
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, kFrames);
}

TEST_F(ResumeTest, AnInputThatChangesOnTheWayIsNeverResumedFrom) {
  // Changed between the start and the first frame: nothing of it is saved under the old input's key.
  EXPECT_EQ(run([&](int) { write_file(root_ / "in.txt", "b"); }), 1);
  EXPECT_FALSE(fs::exists(partial()));
  write_file(root_ / "in.txt", "a");
  // Changed later, when the run fails: what was saved is still of the old input, but nobody can tell.
  EXPECT_EQ(run([&](int frame) {
              if (frame == 3) {
                write_file(root_ / "in.txt", "b");
                throw SolverError("frame 3");
              }
            }),
            1);
  EXPECT_FALSE(fs::exists(partial()));
}

TEST_F(ResumeTest, DamagedFramesAndKeysAreNotBelieved) {
  run_killed_before(3);
  const fs::path frame = partial() / ".scratch/frame_1";
  const std::string whole = read_file(frame);
  write_file(frame, whole.substr(0, whole.size() - 1));
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, 3);
  EXPECT_EQ(read_file(root_ / "out/all.txt"), "a0a1a2a3a4");
  run_killed_before(3);
  write_file(partial() / ".resume-key", "other");
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, kFrames);
}

TEST_F(ResumeTest, AStageThatIsNotResumableBeginsAnew) {
  spec_.resumable = false;
  run_killed_before(3);
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, kFrames);
}

TEST_F(ResumeTest, AStageThatCannotHashItsInputLeavesWhatThereIs) {
  run_killed_before(3);
  fs::remove(root_ / "in.txt");
  // It exists, but cannot be hashed: a folder with a link that leads to itself.
  fs::create_directory(root_ / "in.txt");
  fs::create_symlink(root_ / "in.txt/loop", root_ / "in.txt/loop");
  EXPECT_EQ(run(nothing), 1);
  fs::remove_all(root_ / "in.txt");
  write_file(root_ / "in.txt", "a");
  ASSERT_EQ(run(nothing), 0);
  EXPECT_EQ(solved_, 2);
}

}  // namespace stage_resume_test
}  // namespace tacipc
