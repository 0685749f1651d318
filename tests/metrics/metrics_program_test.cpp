#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>

#include "common/image.h"
#include "tests/metrics/test_images.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace {

class MetricsProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"noise", "fade", "shift"}) {
      const ByteImage image = pattern_image(40, 30);
      std::filesystem::create_directories(folder_ / "ref");
      std::filesystem::create_directories(folder_ / "img");
      write_png(folder_ / ("ref/" + std::string(name) + ".png"), image);
      write_png(folder_ / ("img/" + std::string(name) + ".png"), changed(image, name));
    }
  }

  int run(const std::string& images, const std::string& reference, const std::string& more) {
    const std::string command = "cd '" + (folder_ / "").string() + "' && " + TACIPC_BIN_DIR + "/metrics --config " +
                                TACIPC_SOURCE_DIR + "/configs/metrics/default.yaml --images " + images +
                                " --reference " + reference + " --log-level error " + more + " 2> said";
    const int status = std::system(command.c_str());
    said_ = read_file(folder_ / "said");
    return WEXITSTATUS(status);
  }

  ScratchFolder folder_;
  std::string said_;
};

TEST_F(MetricsProgram, FoldersGiveOneRowPerImageAndTheSameBytesWithAnyThreads) {
  ASSERT_EQ(run("img", "ref", "--out a --threads 1"), 0) << said_;
  ASSERT_EQ(run("img", "ref", "--out b --threads 3"), 0) << said_;
  const std::string csv = read_file(folder_ / "a/samples.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_THAT(csv, testing::HasSubstr("\nfade.png,full,0."));
  EXPECT_EQ(csv, read_file(folder_ / "b/samples.csv"));
  EXPECT_EQ(read_file(folder_ / "a/metrics.yaml"), read_file(folder_ / "b/metrics.yaml"));
  EXPECT_THAT(read_file(folder_ / "a/metrics.yaml"), testing::HasSubstr("ssim_w:\n      mean: 0."));
}

TEST_F(MetricsProgram, ListsOfFilesWork) {
  ASSERT_EQ(run("img/noise.png img/fade.png", "ref/noise.png ref/noise.png", "--out a"), 0) << said_;
  EXPECT_THAT(read_file(folder_ / "a/samples.csv"), testing::HasSubstr("\nnoise.png,full,0."));
}

TEST_F(MetricsProgram, FailuresLeaveNoRecord) {
  std::filesystem::remove(folder_ / "ref/fade.png");
  EXPECT_EQ(run("img", "ref", "--out a"), 1);
  EXPECT_EQ(said_, "metrics: error: img/fade.png has no counterpart in ref\n");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a/metrics.yaml"));
  EXPECT_EQ(run("img ref", "ref", "--out a"), 2);
  EXPECT_EQ(said_, "metrics: error: img: give one folder each, or files only\n");
  EXPECT_EQ(run("nowhere", "ref", "--out a"), 2);
}

}  // namespace
}  // namespace tacipc
