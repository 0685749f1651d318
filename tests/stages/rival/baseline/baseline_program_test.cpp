#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/config/config.h"
#include "common/format/npy.h"
#include "common/image/image.h"
#include "tests/program_test.h"

namespace tacipc {
namespace baseline_program_test {

class BaselineProgram : public ProgramTest {
 protected:
  void SetUp() override {
    const std::string sensor = read_file(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/mctac.yaml");
    std::string small = sensor;
    for (const auto& [from, to] : {std::pair{"width_px: 640", "width_px: 64"}, {"height_px: 480", "height_px: 48"}})
      small.replace(small.find(from), std::string(from).size(), to);
    scratch_.file("sensor.yaml", small);
    // A pyramid of 6 mm edge and 3 mm height, its tip down at the origin.
    scratch_.file("tip.obj",
                  "v 0 0 0\nv -.003 -.003 .003\nv .003 -.003 .003\nv .003 .003 .003\nv -.003 .003 .003\nf 1 3 2\nf 1 4 "
                  "3\nf 1 5 4\nf 1 2 5\nf 2 3 4 5\n");
    write_poses("pose.npy", -1e-3);
    write_png(scratch_ / "background.png", ByteImage(64, 48, 3, 128));
  }

  /// Above the gel, then with the tip at this z.
  void write_poses(const char* file, double pressed_z) {
    std::vector<double> poses;
    for (const double z : {1e-3, pressed_z})
      for (const double v : {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, z, 0.0, 0.0, 0.0, 1.0})
        poses.push_back(v);
    write_npy(scratch_ / file, {2, 4, 4}, poses.data());
  }

  int run(const std::string& config, const std::string& more, const char* log_level = "error") {
    return run_command(
        fmt::format("cd '{}' && {}/baseline --config {}/configs/rivals/baseline/{}.yaml --sensor sensor.yaml "
                    "--log-level {} {}",
                    (scratch_ / "").string(), TACIPC_BIN_DIR, TACIPC_SOURCE_DIR, config, log_level, more));
  }
  const std::string object_ = " --object tip.obj --pose pose.npy";
};

TEST_F(BaselineProgram, AnObjectOverTheGelTouchesNothingAndOneInItDoes) {
  ASSERT_EQ(run("height_map", object_ + " --out a --threads 1"), 0) << said_;
  ASSERT_EQ(run("height_map", object_ + " --out b --threads 3"), 0) << said_;
  EXPECT_EQ(content_hash(scratch_ / "a"), content_hash(scratch_ / "b"));
  const FloatImage apart = read_exr(scratch_ / "a/frame_0000/indentation.exr", {"Y"});
  EXPECT_EQ(*std::max_element(apart.pixels.begin(), apart.pixels.end()), 0.0f);
  const FloatImage pressed = read_exr(scratch_ / "a/frame_0001/indentation.exr", {"Y"});
  const float top = *std::max_element(pressed.pixels.begin(), pressed.pixels.end());
  EXPECT_GT(top, 0.8e-3f);
  EXPECT_LT(top, 1.2e-3f);
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "a/frame_0001/tactile.png"));
  EXPECT_THAT(read_file(scratch_ / "a/baseline.yaml"), testing::HasSubstr("frames: 2"));
}

TEST_F(BaselineProgram, WarnsOfAnObjectThatIsNeverInTheGel) {
  scratch_.file("high.obj", "v 0 0 .0012\nv -.003 -.003 .003\nv .003 -.003 .003\nv .003 .003 .003\nf 1 3 2\nf 1 4 3\n");
  ASSERT_EQ(run("height_map", object_ + " --out a", "warning"), 0);
  EXPECT_EQ(said_, "");
  ASSERT_EQ(run("height_map", " --object high.obj --pose pose.npy --out a", "warning"), 0);
  EXPECT_THAT(said_, testing::HasSubstr("high.obj is in the gel in no frame (it is read in metres)"));
}

TEST_F(BaselineProgram, ItsOwnDepthMapGoesInAgain) {
  ASSERT_EQ(run("height_map", object_ + " --out a"), 0) << said_;
  ASSERT_EQ(run("exponential_13",
                "--depth a/frame_0000/depth.exr a/frame_0001/depth.exr --background background.png --out b"),
            0)
      << said_;
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "b/frame_0001/tactile.png"));
}

TEST_F(BaselineProgram, AnOwnPlaceIsFoundOnItsOwnPhotograph) {
  scratch_.file("lamps.yaml",
                "metallic_lamps: {change_factor: 0.5, lamps: [{position_mm: [25, 0, -6], rgb: [1, 0, 0]}, "
                "{position_mm: [0, 25, -6], rgb: [0, 1, 0]}]}\n");
  write_poses("deep.npy", -1.5e-3);  // of a shallower tip ten pixels show too little of how it is turned
  const std::string lit = " --object tip.obj --pose deep.npy --background background.png --light lamps.yaml";
  scratch_.file("there.yaml", "images: [{name: a, frame: 1}]\nplace: {center_px: [33.25, 22.5], yaw_deg: 5}\n");
  ASSERT_EQ(run("tacto", lit + " --places there.yaml --out there"), 0) << said_;
  scratch_.file("start.yaml",
                "images: [{name: b, frame: 0}, {name: a, frame: 1}]\nplace: {center_px: [31, 24]}\n"
                "fit: {image: a, box_px: [10, 5, 44, 38], yaw: true}\n");
  const std::string fit = lit + " --places start.yaml --photograph there/frame_0000/tactile.png";
  ASSERT_EQ(run("tacto", fit + " --out found"), 0) << said_;
  ConfigReader record = ConfigReader::from_file(scratch_ / "found/baseline.yaml");
  ConfigReader summary = record.section("summary");
  const auto center = summary.numbers("center_px", 2);
  EXPECT_NEAR(center[0], 33.25, 0.05);
  EXPECT_NEAR(center[1], 22.5, 0.05);
  EXPECT_NEAR(summary.number("yaw_deg"), 5.0, 0.1);
  EXPECT_EQ(read_npy(scratch_ / "found/object_pose.npy").shape, (std::vector<std::size_t>{2, 4, 4}));
  // Frames are the images, at that place.
  const ByteImage photograph = read_png(scratch_ / "there/frame_0000/tactile.png", 3);
  const ByteImage image = read_png(scratch_ / "found/frame_0001/tactile.png", 3);
  int worst = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    worst = std::max(worst, std::abs(int{image.pixels[i]} - int{photograph.pixels[i]}));
  EXPECT_LE(worst, 2);
  EXPECT_EQ(run("tacto", lit + " --places start.yaml --out a"), 2);
  EXPECT_EQ(said_, "baseline: error: --photograph: needed where a place is to be fitted to it\n");
}

TEST_F(BaselineProgram, WrongFlagsAndFilesAreSaidOnce) {
  EXPECT_EQ(run("taxim", object_ + " --background background.png --out a"), 2);
  EXPECT_EQ(said_, "baseline: error: --light: needed for the configuration's shading\n");
  EXPECT_EQ(run("chen_2022", object_ + " --background background.png --light pose.npy --out a"), 2);
  EXPECT_EQ(said_, "baseline: error: --light: the configuration's shading has its own\n");
  EXPECT_EQ(run("taxim", object_ + " --background background.png --light pose.npy --out a"), 1);
  EXPECT_EQ(said_, "baseline: error: pose.npy: is no table of bins x bins x 6 x 3\n");
  EXPECT_EQ(run("height_map", "--out a"), 2);
  EXPECT_EQ(said_, "baseline: error: give either --depth or --object\n");
  EXPECT_EQ(run("height_map", "--object tip.obj --out a"), 2);
  EXPECT_EQ(said_, "baseline: error: --object and --pose belong together\n");
  EXPECT_EQ(run("gomes_2021", object_ + " --out a"), 2);
  EXPECT_EQ(said_, "baseline: error: --background: needed where the configuration has shading\n");
  EXPECT_EQ(run("height_map", object_ + " --background background.png --out a"), 2);
  EXPECT_EQ(said_, "baseline: error: --background: the configuration has no shading to use it\n");
  write_png(scratch_ / "small.png", ByteImage(32, 48, 3, 128));
  EXPECT_EQ(run("gomes_2021", object_ + " --background background.png --out a"), 2);
  EXPECT_EQ(said_,
            "baseline: error: front_depth_mm: 30 is not this sensor's, 12, which --object needs; leave it out\n");
  EXPECT_EQ(run("gomes_2021_own_front", object_ + " --background small.png --out a"), 1);
  EXPECT_EQ(said_, "baseline: error: small.png: is 32 x 48 pixels, the sensor's camera has 64 x 48\n");
  std::vector<double> mirror(16, 0.0);
  for (const std::size_t i : {0, 5, 10, 15}) mirror[i] = 1.0;
  mirror[10] = -1.0;
  write_npy(scratch_ / "pose.npy", {4, 4}, mirror.data());
  EXPECT_EQ(run("height_map", object_ + " --out a"), 1);
  EXPECT_EQ(said_, "baseline: error: pose.npy: pose 0 is not a rigid motion\n");
}

}  // namespace baseline_program_test
}  // namespace tacipc
