// Height maps in place of a press.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "common/base/files.h"
#include "common/image/image.h"
#include "tests/stages/image/render/render_stage.h"

namespace tacipc {
namespace render_height_map_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class HeightMapRender : public RenderStage {
 protected:
  void SetUp() override {
    press(slab(80, 60), 2, [](double x, double y) {
      const double dx = x - 0.3e-3;
      return 0.3e-3 * std::exp(-(dx * dx + 2.0 * y * y) / (2.0 * 0.6e-3 * 0.6e-3));
    });
  }
  int run_shapes(const std::string& files, const std::string& out = "shapes") {
    return run_command(fmt::format("{}/render --log-level warning --config {} --sensor {} {} --out {}", TACIPC_BIN_DIR,
                                   (scratch_ / "config.yaml").string(), (scratch_ / "sensor.yaml").string(), files,
                                   (scratch_ / out).string()));
  }
  void write_map(const FloatImage& map) { write_exr(scratch_ / "map.exr", map, {"Y"}); }
  std::string map_flag() { return "--shapes " + (scratch_ / "map.exr").string(); }
};

TEST_F(HeightMapRender, ShowsWhatTheMeshShows) {
  ASSERT_EQ(run("mesh"), 0) << said_;
  // The height of the point that a pixel sees: the camera's height, 5 mm, less its depth.
  FloatImage map = read_exr(scratch_ / "mesh/frame_0001/depth.exr", {"Y"});
  const FloatImage depth = map;
  for (float& value : map.pixels) value = 5e-3f - value;
  write_map(map);
  ASSERT_EQ(run_shapes(map_flag()), 0) << said_;

  // Between pixel centres the membrane is flat: curvatures 0.3 mm / (0.36 mm²) and twice that, times (0.1 mm)² / 8.
  EXPECT_LT(largest_difference(read_exr(scratch_ / "shapes/frame_0001/depth.exr", {"Y"}), depth), 3.1e-6);
  EXPECT_LT(largest_difference(read_exr(scratch_ / "shapes/frame_0001/normal.exr", {"R", "G", "B"}),
                               read_exr(scratch_ / "mesh/frame_0001/normal.exr", {"R", "G", "B"})),
            0.05);
  const ByteImage ours = read_png(scratch_ / "shapes/frame_0001/tactile.png", 3);
  const ByteImage same = read_png(scratch_ / "mesh/frame_0001/tactile.png", 3);
  const ByteImage rest = read_png(scratch_ / "mesh/frame_0000/tactile.png", 3);
  double apart = 0.0, changed = 0.0;
  for (std::size_t i = 0; i < ours.pixels.size(); ++i) {
    apart += std::abs(ours.pixels[i] - same.pixels[i]);
    changed += std::abs(rest.pixels[i] - same.pixels[i]);
  }
  EXPECT_LT(apart, 0.05 * changed);
  EXPECT_EQ(read_png(scratch_ / "shapes/frame_0000/tactile.png", 3).pixels, rest.pixels);
  EXPECT_THAT(read_file(scratch_ / "shapes/render.yaml"), HasSubstr("outside_rays: 0"));
}

TEST_F(HeightMapRender, EveryMapIsAFrame) {
  write_file(scratch_ / "config.yaml", "frames: all\nsubpixels: 1\nnoise: {seed: 1}\n");
  write_map(FloatImage(32, 24, 1));
  ASSERT_EQ(run_shapes(map_flag() + " " + map_flag()), 0) << said_;
  EXPECT_EQ(read_png(scratch_ / "shapes/frame_0002/tactile.png", 3).pixels,
            read_png(scratch_ / "shapes/frame_0000/tactile.png", 3).pixels);
}

TEST_F(HeightMapRender, RefusesWhatIsNoMembrane) {
  FloatImage map(32, 24, 1);
  map.pixels[17] = std::numeric_limits<float>::quiet_NaN();
  write_map(map);
  EXPECT_EQ(run_shapes(map_flag()), 1);
  EXPECT_THAT(said_, HasSubstr("map.exr: has a number that is not finite"));

  write_map(FloatImage(31, 24, 1));
  EXPECT_EQ(run_shapes(map_flag()), 1);
  EXPECT_THAT(said_, HasSubstr("31 x 24"));

  std::string domed = kSensor;
  domed.replace(domed.find("thickness_mm: 1.0"), 17, "thickness_mm: 1.0, dome_radius_mm: 40");
  write_file(scratch_ / "sensor.yaml", domed);
  write_map(FloatImage(32, 24, 1));
  EXPECT_EQ(run_shapes(map_flag()), 1);
  EXPECT_THAT(said_, HasSubstr("the front of slab is a dome"));
}

TEST_F(HeightMapRender, APressOrMaps) {
  write_map(FloatImage(32, 24, 1));
  EXPECT_EQ(run("both", map_flag()), 2);
  EXPECT_THAT(said_, HasSubstr("give either --press and --gel, or --shapes"));
  EXPECT_EQ(run_shapes(""), 2);
  EXPECT_EQ(run_shapes("--gel " + (scratch_ / "gel.msh").string()), 2);
  EXPECT_THAT(said_, HasSubstr("belong together"));
}

}  // namespace render_height_map_test
}  // namespace tacipc
