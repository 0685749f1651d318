#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/image/image.h"
#include "tests/program_test.h"

namespace tacipc {
namespace measure_depths_program_test {

using ::testing::HasSubstr;

class DepthMetrics : public ProgramTest {
 protected:
  void SetUp() override {
    write("rest.exr", 0.0f);
    write("ours/star.exr", 0.4e-3f);
    write("ours/gear.exr", 0.3e-3f);
    write("reference/star.exr", 0.5e-3f);
    write("reference/gear.exr", 0.3e-3f);
  }
  void write(const std::string& name, float press, int width = 32) {
    FloatImage map(width, 24, 1);
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < width; ++x) map.at(x, y, 0) = 12e-3f - (x < 8 ? press : 0.0f);
    std::filesystem::create_directories((scratch_ / name).parent_path());
    write_exr(scratch_ / name, map, {"Y"});
  }
  std::string config_ = TACIPC_SOURCE_DIR "/configs/metrics/depth.yaml";
  int run(const std::string& images, const std::string& references) {
    return run_command(
        fmt::format("cd '{}' && {}/metrics --config {} --rest rest.exr "
                    "--images {} --reference {} --log-level error --out out",
                    (scratch_ / "").string(), TACIPC_BIN_DIR, config_, images, references));
  }
};

TEST_F(DepthMetrics, OneRowPerMapAndRegion) {
  ASSERT_EQ(run("ours/star.exr ours/gear.exr", "reference/star.exr reference/gear.exr"), 0) << said_;
  const std::string csv = read_file(scratch_ / "out/samples.csv");
  EXPECT_THAT(csv, HasSubstr("name,region,pixels,mae_mm,mse_mm2,max_mm,mae_norm,mse_norm,slope_ratio,iou\n"));
  EXPECT_THAT(csv, HasSubstr("\nstar.exr,pressed,192,0.0999"));
  EXPECT_THAT(csv, HasSubstr("\ngear.exr,full,768,0,0,0,0,0,1,1\n"));
  EXPECT_THAT(read_file(scratch_ / "out/metrics.yaml"),
              HasSubstr("pressed:\n    images: 2\n    pixels:\n      mean: 192\n      std: 0\n"));
}

TEST_F(DepthMetrics, ARegionBesideThePress) {
  write_file(scratch_ / "beside.yaml", "kind: depth\npressed_mm: 0.02\nbeside_px: 3\n");
  config_ = "beside.yaml";
  ASSERT_EQ(run("ours/star.exr ours/gear.exr", "reference/star.exr reference/gear.exr"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/samples.csv"), HasSubstr("\nstar.exr,beside,72,0,0,0,0,0,"));
  EXPECT_THAT(read_file(scratch_ / "out/metrics.yaml"), HasSubstr("beside:\n    images: 2\n"));
}

TEST_F(DepthMetrics, ARegionInContactWithTheObject) {
  write("surface/star.exr", 0.505e-3f);
  write_file(scratch_ / "contact.yaml", "kind: depth\npressed_mm: 0.02\ncontact_mm: 0.01\nbeside_px: 3\n");
  EXPECT_EQ(run("ours/star.exr", "reference/star.exr --surface surface/star.exr"), 2);
  EXPECT_EQ(said_, "metrics: error: --surface: belongs to a configuration with contact_mm\n");
  config_ = "contact.yaml";
  EXPECT_EQ(run("ours/star.exr", "reference/star.exr"), 2);
  EXPECT_EQ(run("ours/star.exr ours/gear.exr", "reference/star.exr reference/gear.exr --surface surface/star.exr"), 2);
  EXPECT_EQ(said_, "metrics: error: --surface: 1 files for 2 images\n");
  ASSERT_EQ(run("ours/star.exr", "reference/star.exr --surface surface/star.exr"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/samples.csv"), HasSubstr("\nstar.exr,contact,192,0.0999"));
  EXPECT_THAT(read_file(scratch_ / "out/samples.csv"), HasSubstr("\nstar.exr,beside,72,0,0,0,0,0,"));
  write("surface/star.exr", 0.6e-3f);
  EXPECT_EQ(run("ours/star.exr", "reference/star.exr --surface surface/star.exr"), 1);
  EXPECT_THAT(said_, HasSubstr("the reference is nowhere within 0.01 mm of the object's surface"));
}

TEST_F(DepthMetrics, RefusesWhatDoesNotFit) {
  EXPECT_EQ(run("ours/star.exr ours/gear.exr", "reference/star.exr"), 2);
  EXPECT_EQ(said_, "metrics: error: 2 images but 1 references: lists are compared pair by pair\n");
  write("narrow.exr", 0.2e-3f, 16);
  EXPECT_EQ(run("narrow.exr", "reference/star.exr"), 1);
  EXPECT_EQ(said_, "metrics: error: narrow.exr: is 16 x 24 pixels, the gel at rest 32 x 24\n");
  EXPECT_EQ(run("ours/star.exr", "rest.exr"), 1);
  EXPECT_THAT(said_, HasSubstr("ours/star.exr against rest.exr: the reference is nowhere pressed deeper than 0.02 mm"));
}

}  // namespace measure_depths_program_test
}  // namespace tacipc
