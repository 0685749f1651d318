// What is on the disk when: fsync and rename stand in for the C library's here, note the order and do the work.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <string>
#include <vector>

#include "common/base/files.h"
#include "common/stage/stage.h"
#include "tests/scratch_folder.h"

namespace {

std::vector<std::string> calls;
std::string broken;  // the file whose bytes the disk refuses

std::string last_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }

}  // namespace

extern "C" int fsync(int file) {
  const std::string path = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file)).string();
  if (last_name(path) == broken) {
    errno = EIO;
    return -1;
  }
  calls.push_back("flush " + last_name(path));
  return static_cast<int>(::syscall(SYS_fsync, file));
}

extern "C" int rename(const char* from, const char* to) noexcept {
  calls.push_back("rename " + last_name(to));
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace tacipc {
namespace {

namespace fs = std::filesystem;

class FlushTest : public ::testing::Test {
 protected:
  int run() {
    calls.clear();
    const std::string out = (root_ / "out").string();
    std::vector<std::string> words{"copy", "--out", out, "--log-level", "off"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ::testing::internal::CaptureStderr();
    const int code = run_stage(spec_, static_cast<int>(argv.size()), argv.data(), [](Stage& stage) {
      write_file(stage.output("top.txt"), "one");
      write_file(stage.output("frame/deep.txt"), "two");
    });
    said_ = ::testing::internal::GetCapturedStderr();
    return code;
  }

  /// Where a call stands. It is there once.
  static std::ptrdiff_t at(const std::string& call) {
    EXPECT_EQ(std::count(calls.begin(), calls.end(), call), 1) << call;
    return std::find(calls.begin(), calls.end(), call) - calls.begin();
  }

  void TearDown() override { broken.clear(); }

  StageSpec spec_{.name = "copy", .summary = "Copies.", .inputs = {}};
  ScratchFolder root_;
  std::string said_;
};

TEST_F(FlushTest, BytesAreOnTheDiskBeforeTheirNameAndTheRecordComesLast) {
  for (const bool keeps : {false, true}) {
    spec_.keeps_old_until_done = keeps;
    ASSERT_EQ(run(), 0) << said_;
    for (const std::string file : {"top.txt", "deep.txt", "copy.yaml"})
      EXPECT_LT(at("flush " + file), at("rename " + file)) << file;
    // Names, too: those of outputs before the record's, the record's before the stage ends.
    EXPECT_LT(at("rename deep.txt"), at("flush frame"));
    EXPECT_LT(at("flush frame"), at("rename copy.yaml"));
    const std::vector<std::string> end(calls.end() - 3, calls.end());
    EXPECT_THAT(end, ::testing::ElementsAre(::testing::StartsWith("flush "), "rename copy.yaml", "flush out"));
  }
}

TEST_F(FlushTest, WhatTheDiskRefusesIsNoResult) {
  broken = "deep.txt";
  EXPECT_EQ(run(), 1);
  EXPECT_THAT(said_, ::testing::AllOf(::testing::StartsWith("copy: error: "), ::testing::HasSubstr("deep.txt"),
                                      ::testing::HasSubstr("Input/output error")));
  EXPECT_FALSE(fs::exists(root_ / "out/copy.yaml"));
  EXPECT_FALSE(fs::exists(root_ / "out/top.txt"));
}

TEST_F(FlushTest, AFolderThatIsGoneSaysSo) { EXPECT_THROW(flush_to_disk({root_ / "nowhere"}), std::runtime_error); }

}  // namespace
}  // namespace tacipc
