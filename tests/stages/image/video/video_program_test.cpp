// The program as a user runs it: a file whose frames, times and colours are those of the images.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "common/format/npy.h"
#include "common/sample/film.h"
#include "common/stage/record.h"
#include "tests/program_test.h"
#include "tests/stages/image/video/read_mp4.h"

namespace tacipc {
namespace video_program_test {

namespace fs = std::filesystem;
using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::HasSubstr;

class VideoProgramTest : public ProgramTest {
 protected:
  static constexpr int kFrames = 60, kWidth = 64, kHeight = 48;

  /// A smooth spot that wanders over the image and changes its colour.
  static ByteImage spot(int frame, int channel) {
    ByteImage image(kWidth, kHeight, 3, 90);
    const double x0 = 10.0 + 0.7 * frame, y0 = 24.0 + 10.0 * std::sin(0.2 * frame);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        image.at(x, y, channel) =
            static_cast<std::uint8_t>(90.0 + 140.0 * std::exp(-((x - x0) * (x - x0) + (y - y0) * (y - y0)) / 120.0));
    return image;
  }
  /// A press of that many frames 10 ms apart with images of all.
  void write_gel(const std::string& folder, int channel = 0) {
    const fs::path press = scratch_ / (folder + "press"), render = scratch_ / (folder + "render");
    scratch_.file(folder + "press/press.yaml", "stage: press\nof: " + folder + "\n");
    std::vector<double> times, positions(kFrames * 3, 0.0);
    for (int f = 0; f < kFrames; ++f) times.push_back(0.01 * f);
    write_npy(press / "time.npy", {kFrames}, times.data());
    write_npy(press / "positions.npy", {kFrames, 1, 3}, positions.data());
    for (int f = 0; f < kFrames; ++f) {
      const fs::path frame = render / fmt::format("frame_{:04}", f);
      fs::create_directories(frame);
      write_png(frame / "tactile.png", spot(f, channel));
      write_png(frame / "marker.png", spot(f, channel + 1));
      write_exr(frame / "indentation.exr", FloatImage(kWidth, kHeight, 1, static_cast<float>(1e-5 * f)), {"Y"});
    }
    write_file(render / "render.yaml",
               fmt::format("stage: render\ninputs:\n  press: {{path: ../press, hash: {}}}\n", content_hash(press)));
  }
  int run(const std::string& flags, const std::string& out = "video") {
    return run_command(fmt::format("cd {} && {}/video --log-level warning --out {} {}", (scratch_ / "").string(),
                                   TACIPC_BIN_DIR, out, flags));
  }
  static double mean_difference(const ByteImage& a, const ByteImage& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(int{a.pixels[i]} - int{b.pixels[i]});
    return sum / static_cast<double>(a.pixels.size());
  }
  /// The largest of the three channels.
  static double mean_shift(const ByteImage& a, const ByteImage& b) {
    std::array<double, 3> sums{};
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sums[i % 3] += int{a.pixels[i]} - int{b.pixels[i]};
    return 3.0 * std::max({std::abs(sums[0]), std::abs(sums[1]), std::abs(sums[2])}) /
           static_cast<double>(a.pixels.size());
  }
};

TEST_F(VideoProgramTest, TheFileHasEveryFrameInItsColoursAndTime) {
  write_gel("");
  ASSERT_EQ(run("--press press --render render"), 0) << said_;
  const ReadMp4 film = read_mp4(scratch_ / "video/video.mp4");
  const std::string bytes = read_file(scratch_ / "video/video.mp4");
  EXPECT_LT(bytes.find("moov"), bytes.find("mdat")) << "the index comes first";
  const std::vector<ByteImage>& images = film.images;
  ASSERT_EQ(images.size(), std::size_t{kFrames});
  EXPECT_EQ(film.keys[0], 0u);
  EXPECT_THAT(film.keys, testing::Contains(50u));
  // 10 ms, ten times slower.
  EXPECT_THAT(film.seconds, Each(DoubleNear(0.1, 1e-6)));
  EXPECT_NEAR(film.whole_s, 0.1 * kFrames, 1e-6);
  const Film expected({{scratch_ / "press", scratch_ / "render"}}, kFrames, {4000, 4000});
  for (const std::size_t f : {0, 1, 17, 49, 50, 59}) {
    const ByteImage picture = expected.picture(f);
    ASSERT_EQ(images[f].width, picture.width);
    ASSERT_EQ(images[f].height, picture.height);
    EXPECT_LT(mean_difference(images[f], picture), 3.0) << f;
    EXPECT_LT(mean_shift(images[f], picture), 0.5) << f;
    EXPECT_GT(mean_difference(images[f], expected.picture((f + 20) % kFrames)), 4.0) << "another frame";
  }
  const Record record = Record::from_file(scratch_ / "video/video.yaml");
  const Record summary = record.section("summary");
  EXPECT_EQ(summary.required_number("frames"), kFrames);
  EXPECT_EQ(summary.required_number("slower"), 10.0);
  EXPECT_NEAR(summary.required_number("seconds"), 6.0, 1e-9);
}

TEST_F(VideoProgramTest, TheSameImagesAreTheSameBytes) {
  write_gel("");
  ASSERT_EQ(run("--press press --render render --threads 1", "one"), 0) << said_;
  ASSERT_EQ(run("--press press --render render --threads 3", "two"), 0) << said_;
  for (const char* name : {"video.mp4", "video.yaml"})
    EXPECT_EQ(read_file(scratch_ / "one" / name), read_file(scratch_ / "two" / name)) << name;
  ASSERT_EQ(run("--press press --render render --slower 1", "real"), 0) << said_;
  EXPECT_THAT(read_mp4(scratch_ / "real/video.mp4").seconds, Each(DoubleNear(0.01, 1e-6)));
}

/// Fingers in rows, whatever the order in which their images are given.
TEST_F(VideoProgramTest, AGraspHasARowForEachFinger) {
  write_gel("left/", 0);
  write_gel("right/", 1);
  scratch_.file("press.yaml", "stage: press\n");
  std::vector<double> times, fingers, object;
  const auto add = [](std::vector<double>& poses) {
    for (int i = 0; i < 16; ++i) poses.push_back(i % 5 == 0 ? 1.0 : 0.0);
  };
  for (int f = 0; f < kFrames; ++f) times.push_back(0.02 * f), add(fingers), add(fingers), add(object);
  write_npy(scratch_ / "time.npy", {kFrames}, times.data());
  write_npy(scratch_ / "finger_pose.npy", {kFrames, 2, 4, 4}, fingers.data());
  write_npy(scratch_ / "object_world_pose.npy", {kFrames, 4, 4}, object.data());
  ASSERT_EQ(run("--press . --render right/render --render left/render"), 0) << said_;
  const ReadMp4 film = read_mp4(scratch_ / "video/video.mp4");
  EXPECT_THAT(film.seconds, Each(DoubleNear(0.1, 1e-6))) << "20 ms, five times slower";
  const ByteImage& first = film.images.at(0);
  EXPECT_EQ(first.height, 2 * kHeight + 4);
  EXPECT_GT(first.at(10, 24, 0), first.at(10, 24, 1) + 60) << "left above, red";
  EXPECT_GT(first.at(10, kHeight + 4 + 24, 1), first.at(10, kHeight + 4 + 24, 0) + 60) << "right below, green";
  EXPECT_EQ(run("--press . --render right/render"), 2);
  EXPECT_THAT(said_, HasSubstr("--render: 1 are given for 2 gels"));
  EXPECT_EQ(run("--press . --render right/render --render right/render"), 1);
  EXPECT_THAT(said_, HasSubstr("no --render is of "));
}

TEST_F(VideoProgramTest, WhatIsMissingIsSaidInOneLine) {
  write_gel("");
  fs::remove_all(scratch_ / "render/frame_0031");
  EXPECT_EQ(run("--press press --render render"), 1);
  EXPECT_EQ(said_,
            "video: error: render: frame 31 of 0 to 59 is not there; a film needs all (frames: all of the render's "
            "file)\n");
  EXPECT_FALSE(fs::exists(scratch_ / "video/video.mp4"));
  fs::remove(scratch_ / "render/render.yaml");
  EXPECT_EQ(run("--press press --render render"), 1);
  EXPECT_EQ(said_, "video: error: render: has no render.yaml, so the render did not finish\n");
  for (const char* wrong : {"0", "-2", "fast", "1x"}) {
    EXPECT_EQ(run(fmt::format("--press press --render render --slower {}", wrong)), 2) << wrong;
    EXPECT_EQ(said_, fmt::format("video: error: --slower: '{}' is neither a number above 0 nor auto\n", wrong));
  }
}

}  // namespace video_program_test
}  // namespace tacipc
