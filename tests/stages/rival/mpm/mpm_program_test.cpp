// The program as a user runs it, on a gel of a few thousand particles.
#include <gmock/gmock.h>

#include "common/format/npy.h"
#include "common/image/image.h"
#include "common/mesh/triangle_mesh.h"
#include "tests/make_mesh.h"
#include "tests/program_test.h"

namespace tacipc {
namespace mpm_program_test {

using ::testing::HasSubstr;

class MpmProgram : public ProgramTest {
 protected:
  MpmProgram() {
    // The MC-Tac with a gel of 3 mm radius, a small picture and few markers.
    std::string sensor = read_file(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/mctac.yaml");
    replace(sensor, "radius_mm: 15.0 ", "radius_mm: 3.0 ");
    replace(sensor, "width_px: 640", "width_px: 32");
    replace(sensor, "height_px: 480", "height_px: 24");
    replace(sensor, "window_mm: [15.0, 11.25]", "window_mm: [4.0, 3.0]");
    replace(sensor, "rows: 19 ", "rows: 3 ");
    replace(sensor, "columns: 19", "columns: 3");
    scratch_.file("sensor.yaml", sensor);
    config_ = read_file(std::string(TACIPC_SOURCE_DIR) + "/configs/rivals/mpm/physical_checked.yaml");
    replace(config_, "spacing_mm: 0.1", "spacing_mm: 0.2");
    replace(config_, "spacing_mm: 0.2           #", "spacing_mm: 0.4  #");
    replace(config_, "press_speed_mm_s: 50", "press_speed_mm_s: 400");
    replace(config_, "move_speed_mm_s: 50", "move_speed_mm_s: 400");
    replace(config_, "largest_change: 0.02", "largest_change: 0.5");
    scratch_.file("mpm.yaml", config_);
    scratch_.file("sample.yaml",
                  "motion:\n  - {kind: press, depth_mm: 0.2, steps: 2}\n"
                  "  - {kind: shear, distance_mm: 0.1, steps: 2}\n");
    const TriangleMesh tip = make_mesh({{0, 0, 0}, {2e-3, 0, 2e-3}, {-1e-3, 2e-3, 2e-3}, {-1e-3, -2e-3, 2e-3}},
                                       {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}});
    write_ply(scratch_ / "object.ply", tip);
  }

  static void replace(std::string& text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }

  int run_mpm(const std::string& out, const std::string& more = "", const std::string& sample = "sample.yaml") {
    return run_command(std::string(TACIPC_BIN_DIR) + "/mpm --config " + (scratch_ / "mpm.yaml").string() +
                       " --sensor " + (scratch_ / "sensor.yaml").string() + " --sample " +
                       (scratch_ / sample).string() + " --object " + (scratch_ / "object.ply").string() + " --out " +
                       (scratch_ / out).string() + " " + more);
  }

  std::string config_;
};

TEST_F(MpmProgram, WritesWhatPressAndBaselineDo) {
  ASSERT_EQ(run_mpm("out"), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("half the speed changes the markers by"));
  EXPECT_EQ(read_npy(scratch_ / "out/markers.npy").shape, (std::vector<std::size_t>{5, 9, 3}));
  const NpyArray displacement = read_npy(scratch_ / "out/marker_displacement.npy");
  EXPECT_EQ(displacement.shape, (std::vector<std::size_t>{5, 9, 2, 3}));
  EXPECT_EQ(read_npy(scratch_ / "out/object_pose.npy").shape, (std::vector<std::size_t>{5, 4, 4}));
  EXPECT_EQ(read_npy(scratch_ / "out/phase.npy").data, (std::vector<double>{0, 2, 2, 3, 3}));
  EXPECT_EQ(read_npy(scratch_ / "out/time.npy").shape, (std::vector<std::size_t>{5}));
  // The marker in the middle goes down with the tip, then along with it; since the press ended it has only gone along.
  const auto at = [&](std::size_t frame, std::size_t since, std::size_t axis) {
    return displacement.data[((frame * 9 + 4) * 2 + since) * 3 + axis];
  };
  EXPECT_LT(at(2, 0, 2), -0.1e-3);
  EXPECT_EQ(at(2, 1, 2), 0.0);
  EXPECT_GT(at(4, 1, 0), 0.04e-3);
  const FloatImage rest = read_exr(scratch_ / "out/frame_0000/indentation.exr", {"Y"}),
                   pressed = read_exr(scratch_ / "out/frame_0002/indentation.exr", {"Y"}),
                   depth = read_exr(scratch_ / "out/frame_0002/depth.exr", {"Y"});
  EXPECT_EQ(rest.width, 32);
  EXPECT_EQ(rest.at(16, 12, 0), 0.0f);
  EXPECT_GT(pressed.at(16, 12, 0), 0.1e-3f);
  EXPECT_LT(pressed.at(0, 0, 0), 0.05e-3f);
  EXPECT_NEAR(depth.at(16, 12, 0), 12e-3f - pressed.at(16, 12, 0), 1e-8f);
  const std::string record = read_file(scratch_ / "out/mpm.yaml");
  for (const std::string line :
       {"largest_mach: ", "substeps: ", "momentum_kg_m_s: ", "gel_depth_m: ", "object_points_per_mm2: 100.",
        "marker_change_at_half_speed: ", "press_end_frame: 2", "courant: 0.4"})
    EXPECT_THAT(record, HasSubstr(line));
}

TEST_F(MpmProgram, SameBytesWithAnyNumberOfThreads) {
  ASSERT_EQ(run_mpm("one", "--threads 1"), 0) << said_;
  ASSERT_EQ(run_mpm("three", "--threads 3"), 0) << said_;
  for (const std::string file : {"mpm.yaml", "markers.npy", "marker_displacement.npy", "object_pose.npy",
                                 "frame_0004/indentation.exr", "frame_0004/depth.exr", "markers.csv"})
    EXPECT_EQ(read_file(scratch_ / ("one/" + file)), read_file(scratch_ / ("three/" + file))) << file;
}

TEST_F(MpmProgram, FailsWhereHalfTheSpeedChangesTooMuch) {
  replace(config_, "largest_change: 0.5", "largest_change: 1.0e-6");
  scratch_.file("mpm.yaml", config_);
  EXPECT_EQ(run_mpm("out"), 1);
  EXPECT_THAT(said_, HasSubstr("half the speed changes the markers by"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/mpm.yaml"));
  EXPECT_THAT(read_file(scratch_ / "out/mpm.failed.yaml"), HasSubstr("check: marker_change_at_half_speed"));
}

TEST_F(MpmProgram, WritesNoHeightMapsWhereNoneAreWanted) {
  replace(config_, "pixels: centres", "pixels: none");
  config_.resize(config_.find("half_speed:"));
  scratch_.file("mpm.yaml", config_);
  ASSERT_EQ(run_mpm("out"), 0) << said_;
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/marker_displacement.npy"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/frame_0004"));
}

TEST_F(MpmProgram, RefusesLoads) {
  scratch_.file("load.yaml", "object: {density_kg_m3: 1000}\nmotion: {kind: press, force_n: 1, steps: 2}\n");
  EXPECT_EQ(run_mpm("out", "", "load.yaml"), 2);
  EXPECT_THAT(said_, HasSubstr("mpm moves it by prescribed motions only"));
  scratch_.file("free.yaml", "object: {density_kg_m3: 1000}\nmotion: {kind: free, steps: 2}\n");
  EXPECT_EQ(run_mpm("out", "", "free.yaml"), 2);
  EXPECT_THAT(said_, HasSubstr("the sample lets the object go"));
}

}  // namespace mpm_program_test
}  // namespace tacipc
