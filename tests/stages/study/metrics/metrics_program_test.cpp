#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>

#include "common/image/image.h"
#include "tests/program_test.h"
#include "tests/stages/study/metrics/test_images.h"

namespace tacipc {
namespace metrics_program_test {

class MetricsProgram : public ProgramTest {
 protected:
  void SetUp() override {
    for (const char* name : {"noise", "fade", "shift"}) {
      const ByteImage image = pattern_image(40, 30);
      std::filesystem::create_directories(scratch_ / "ref");
      std::filesystem::create_directories(scratch_ / "img");
      write_png(scratch_ / ("ref/" + std::string(name) + ".png"), image);
      write_png(scratch_ / ("img/" + std::string(name) + ".png"), changed(image, name));
    }
  }

  int run(const std::string& images, const std::string& reference, const std::string& more) {
    return run_command(
        fmt::format("cd '{}' && {}/metrics --config {}/configs/metrics/images.yaml --images {} --reference {} "
                    "--log-level error {}",
                    (scratch_ / "").string(), TACIPC_BIN_DIR, TACIPC_SOURCE_DIR, images, reference, more));
  }
};

TEST_F(MetricsProgram, FoldersGiveOneRowPerImageAndTheSameBytesWithAnyThreads) {
  ASSERT_EQ(run("img", "ref", "--out a --threads 1"), 0) << said_;
  ASSERT_EQ(run("img", "ref", "--out b --threads 3"), 0) << said_;
  const std::string csv = read_file(scratch_ / "a/samples.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_THAT(csv, testing::HasSubstr("\nfade.png,full,0."));
  EXPECT_EQ(csv, read_file(scratch_ / "b/samples.csv"));
  EXPECT_EQ(read_file(scratch_ / "a/metrics.yaml"), read_file(scratch_ / "b/metrics.yaml"));
  EXPECT_THAT(read_file(scratch_ / "a/metrics.yaml"), testing::HasSubstr("ssim_w:\n      mean: 0."));
}

TEST_F(MetricsProgram, ListsOfFilesWork) {
  ASSERT_EQ(run("img/noise.png img/fade.png", "ref/noise.png ref/noise.png", "--out a"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "a/samples.csv"), testing::HasSubstr("\nnoise.png,full,0."));
}

TEST_F(MetricsProgram, FailuresLeaveNoRecord) {
  std::filesystem::remove(scratch_ / "ref/fade.png");
  EXPECT_EQ(run("img", "ref", "--out a"), 1);
  EXPECT_EQ(said_, "metrics: error: img/fade.png has no counterpart in ref\n");
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "a/metrics.yaml"));
  EXPECT_EQ(run("img ref", "ref", "--out a"), 2);
  EXPECT_EQ(said_, "metrics: error: img: give one folder each, or files only\n");
  EXPECT_EQ(run("nowhere", "ref", "--out a"), 2);
  EXPECT_EQ(run("img", "img", "--out a --rest ref/noise.png"), 2);
  EXPECT_EQ(said_, "metrics: error: --rest: is for depth maps, and the configuration is for images\n");
}

}  // namespace metrics_program_test
}  // namespace tacipc
