// The program as a user runs it.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/program_test.h"
#include "tests/stages/gel/export/pressed_cube.h"
#include "tests/stages/gel/export/vtu_reader.h"

namespace tacipc {
namespace export_stage_test {

using ::testing::HasSubstr;

class ExportStageTest : public ProgramTest {
 protected:
  void SetUp() override { write_pressed_cube(scratch_); }

  int run(const std::string& out, const std::string& more = "", const std::string& press = "press") {
    return run_command(fmt::format("cd {} && {}/export --press {} --gel gel.msh --object object.ply --out {} {}",
                                   (scratch_ / "").string(), TACIPC_BIN_DIR, press, out, more));
  }
};

TEST_F(ExportStageTest, WritesThreeFilesAFrameAndThreeCollections) {
  ASSERT_EQ(run("vtk"), 0) << said_;
  for (const char* kind : {"surface", "volume", "object"}) {
    const std::string collection = read_file(scratch_ / fmt::format("vtk/{}.pvd", kind));
    for (const int frame : {0, 1}) {
      const std::string name = fmt::format("{}_{:04}.vtu", kind, frame);
      EXPECT_THAT(collection, HasSubstr(fmt::format("timestep=\"{}\" part=\"0\" file=\"{}\"", frame * 0.01, name)));
      const VtuFile file = parse_vtu(read_file(scratch_ / ("vtk/" + name)));
      EXPECT_EQ(file.points, std::string(kind) == "surface" ? 8u : std::string(kind) == "volume" ? 9u : 4u);
    }
  }
  const VtuFile surface = parse_vtu(read_file(scratch_ / "vtk/surface_0001.vtu"));
  EXPECT_EQ(surface.arrays.at("normal_force").values[3 * 7 + 2], -4.0);
  EXPECT_EQ(surface.arrays.at("contact_state").values[7], 2.0);
  const std::string record = read_file(scratch_ / "vtk/export.yaml");
  EXPECT_THAT(record, HasSubstr("summary:\n  frames: 2\n  gel_vertices: 9\n  tets: 12\n  object_triangles: 4\n"));
  ASSERT_EQ(run("again", "--threads 1"), 0);
  EXPECT_EQ(read_file(scratch_ / "again/export.yaml"), record);
}

TEST_F(ExportStageTest, SurfacesHavePositionsAndVelocities) {
  ASSERT_EQ(run("vtk"), 0) << said_;
  const NpyArray positions = read_npy(scratch_ / "vtk/surfaces/gel/positions.npy", {2, 8, 3}),
                 velocities = read_npy(scratch_ / "vtk/surfaces/gel/velocities.npy", {2, 8, 3});
  // The vertex inside is left out; the front goes down by 2 mm in 10 ms, what is glued stays.
  EXPECT_NEAR(positions.data[24 + 3 * 7 + 2], -0.002, 1e-15);
  EXPECT_NEAR(velocities.data[24 + 3 * 7 + 2], -0.2, 1e-12);
  EXPECT_EQ(velocities.data[24 + 2], 0.0);
  EXPECT_EQ(velocities.data[3 * 7 + 2], 0.0);
  read_npy(scratch_ / "vtk/surfaces/gel/triangles.npy", {12, 3});
  const NpyArray object = read_npy(scratch_ / "vtk/surfaces/object/velocities.npy", {2, 4, 3});
  // The corner at its origin goes by (1, 2, 3) from where frame 0 has it.
  const NpyArray at = read_npy(scratch_ / "vtk/surfaces/object/positions.npy", {2, 4, 3});
  for (std::size_t k = 9; k < 12; ++k) EXPECT_NEAR(object.data[12 + k], (at.data[12 + k] - at.data[k]) / 0.01, 1e-9);
  EXPECT_GT(std::abs(object.data[12 + 9]), 1.0);
}

TEST_F(ExportStageTest, OfAGraspEveryGelIsInTheWorld) {
  write_pressed_scene(scratch_);
  ASSERT_EQ(run("scene/export", "", "scene"), 0) << said_;
  const std::string collection = read_file(scratch_ / "scene/export/surface.pvd");
  EXPECT_THAT(collection, HasSubstr("timestep=\"0.01\" part=\"0\" file=\"surface_left_0001.vtu\""));
  EXPECT_THAT(collection, HasSubstr("timestep=\"0.01\" part=\"1\" file=\"surface_right_0001.vtu\""));
  const VtuFile left = parse_vtu(read_file(scratch_ / "scene/export/surface_left_0001.vtu"));
  const VtuFile right = parse_vtu(read_file(scratch_ / "scene/export/surface_right_0001.vtu"));
  // The front, pressed in by 2 mm, of fingers whose S is at x = ∓15 mm.
  EXPECT_NEAR(left.arrays.at("Points").values[3 * 7], -0.015 - 0.002, 1e-15);
  EXPECT_NEAR(right.arrays.at("Points").values[3 * 7], 0.015 + 0.002, 1e-15);
  EXPECT_EQ(left.arrays.at("normal_force").values[3 * 7], -4.0);
  const VtuFile object = parse_vtu(read_file(scratch_ / "scene/export/object_0001.vtu"));
  EXPECT_NEAR(object.arrays.at("Points").values[3 * 2 + 2], 1.0 - 0.003, 1e-15);
  EXPECT_THAT(read_file(scratch_ / "scene/export/export.yaml"),
              HasSubstr("summary:\n  frames: 2\n  gel_vertices: 18\n  tets: 24\n  object_triangles: 4\n"));
  const std::string first = read_file(scratch_ / "scene/export/export.yaml");
  ASSERT_EQ(run("scene/export", "", "scene"), 0) << said_;  // its own outputs are not part of what it reads
  EXPECT_EQ(read_file(scratch_ / "scene/export/export.yaml"), first);
}

TEST_F(ExportStageTest, OfASceneEveryBodyIsInTheWorld) {
  write_pressed_bodies(scratch_);
  const auto run_scene = [&](const std::string& more) {
    return run_command(fmt::format("cd {} && {}/export --press bodies --gel gel.msh --out vtk {}",
                                   (scratch_ / "").string(), TACIPC_BIN_DIR, more));
  };
  ASSERT_EQ(run_scene(""), 0) << said_;
  const std::vector<double> peg = parse_vtu(read_file(scratch_ / "vtk/object_peg_0001.vtu")).arrays.at("Points").values;
  EXPECT_NEAR(peg[3 * 2 + 2], 1.0 - 0.003, 1e-15);
  const std::vector<double> wall =
      parse_vtu(read_file(scratch_ / "vtk/object_wall_0001.vtu")).arrays.at("Points").values;
  EXPECT_NEAR(wall[3 * 2 + 2], 1e-3, 1e-15);
  VtuFile soft = parse_vtu(read_file(scratch_ / "vtk/soft_ball_0001.vtu"));
  EXPECT_EQ(soft.points, 9u);
  EXPECT_NEAR(soft.arrays.at("displacement").values[3 * 8 + 2], 1e-3, 1e-15);
  EXPECT_NEAR(soft.arrays.at("volume_ratio").values[0], 1.0, 1e-9);
  EXPECT_THAT(read_file(scratch_ / "vtk/soft.pvd"), HasSubstr("file=\"soft_ball_0001.vtu\""));
  EXPECT_EQ(parse_vtu(read_file(scratch_ / "vtk/surface_pad_0001.vtu")).points, 8u);
  const std::string glb = read_file(scratch_ / "vtk/sample.glb");
  for (const char* node : {"gel pad", "object peg", "object wall", "soft ball"})
    EXPECT_NE(glb.find(fmt::format("\"name\": \"{}\"", node)), std::string::npos) << node;
  EXPECT_EQ(run_scene("--object object.ply"), 2);
  EXPECT_THAT(said_, HasSubstr("--object: the record of a scene names its bodies"));
  write_file(scratch_ / "ball.msh", "another");
  EXPECT_EQ(run_scene(""), 1);
  EXPECT_THAT(said_, HasSubstr("ball.msh: is not the body_ball that bodies/press.yaml was made with"));
}

TEST_F(ExportStageTest, APressWithoutItsObjectIsRefused) {
  EXPECT_EQ(run_command(fmt::format("cd {} && {}/export --press press --gel gel.msh --out vtk",
                                    (scratch_ / "").string(), TACIPC_BIN_DIR)),
            2);
  EXPECT_THAT(said_, HasSubstr("--object is missing"));
}

TEST_F(ExportStageTest, FingersOfOtherFramesThanTheirPosesAreAFailure) {
  write_pressed_scene(scratch_);
  const std::vector<double> times{0.0};
  write_npy(scratch_ / "scene/left/press/time.npy", {1}, times.data());
  EXPECT_EQ(run("scene/export", "", "scene"), 1);
  EXPECT_EQ(said_, "export: error: scene/left/press/time.npy: has the shape (1,), expected (2,)\n");
}

TEST_F(ExportStageTest, AnUnfinishedPressIsAFailureWithItsReason) {
  std::filesystem::remove(scratch_ / "press/press.yaml");
  EXPECT_EQ(run("vtk"), 1);
  EXPECT_EQ(said_, "export: error: press: has no press.yaml, so the press did not finish\n");
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "vtk/export.yaml"));
  EXPECT_THAT(read_file(scratch_ / "vtk/export.failed.yaml"),
              HasSubstr("message: \"press: has no press.yaml, so the press did not finish\"\n"));
}

}  // namespace export_stage_test
}  // namespace tacipc
