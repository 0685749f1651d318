// The program as a user runs it.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/program_test.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace {

class DecimateStage : public ProgramTest {
 protected:
  int run(const std::string& out, const std::string& threads = "1") {
    return run_command(fmt::format(
        "{}/decimate --config {}/configs/objects/decimate/default.yaml --mesh {} --object {} --out {} --threads {}",
        TACIPC_BIN_DIR, TACIPC_SOURCE_DIR, mesh_.string(), object_.string(), (scratch_ / out).string(), threads));
  }

  std::filesystem::path mesh_ = scratch_ / "mesh.ply";
  std::filesystem::path object_ = scratch_.file("object.yaml", "unit: m\nup: \"-z\"\n");
};

TEST_F(DecimateStage, WritesTheSameObjectAndRecordOnAnyNumberOfThreads) {
  write_ply(mesh_, bumpy_torus(0.008, 0.003, 0.1, 150, 80));
  ASSERT_EQ(run("one", "1"), 0) << said_;
  ASSERT_EQ(run("two", "2"), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "one/object.ply"), read_file(scratch_ / "two/object.ply"));
  const std::string record = read_file(scratch_ / "one/decimate.yaml");
  EXPECT_EQ(record, read_file(scratch_ / "two/decimate.yaml"));
  for (const char* line : {"up: -z", "input_vertices: 12000", "vertices: 8000", "faces: 16000", "hausdorff_mm:"})
    EXPECT_THAT(record, ::testing::HasSubstr(line));
  EXPECT_EQ(read_triangle_mesh(scratch_ / "one/object.ply", 1.0).num_vertices(), 8000);
}

TEST_F(DecimateStage, SaysWhatItPassedThrough) {
  const TriangleMesh ball = sphere(0.005, 3);
  write_ply(mesh_, ball);
  ASSERT_EQ(run("out"), 0);
  EXPECT_THAT(said_, ::testing::HasSubstr("decimate: nothing to repair\n"));
  EXPECT_THAT(said_, ::testing::HasSubstr("258 vertices are no more than the target 8000: passed through unchanged\n"));
  EXPECT_EQ(read_file(scratch_ / "out/object.ply"), read_file(mesh_));
}

TEST_F(DecimateStage, TellsOnATerminalHowFarTheSearchForCrossingsIs) {
  write_ply(mesh_, sphere(0.005, 3));
  const std::string decimate = fmt::format(
      "{}/decimate --config {}/configs/objects/decimate/default.yaml --mesh {} --object {} --out {} --threads 1",
      TACIPC_BIN_DIR, TACIPC_SOURCE_DIR, mesh_.string(), object_.string(), (scratch_ / "out").string());
  ASSERT_EQ(run_command(fmt::format("script -qec '{}' {} > {}", decimate, (scratch_ / "terminal.txt").string(),
                                    (scratch_ / "stdout.txt").string())),
            0);
  const std::string terminal = read_file(scratch_ / "terminal.txt");
  EXPECT_THAT(terminal, ::testing::HasSubstr("decimate: 12 % of the faces searched for crossings"));
  EXPECT_THAT(terminal, ::testing::HasSubstr("decimate: 100 % of the faces searched for crossings"));
}

TEST_F(DecimateStage, RefusesWithOneLine) {
  write_ply(mesh_, sphere(5.0, 2));
  EXPECT_EQ(run("out"), 1);
  EXPECT_THAT(said_,
              ::testing::EndsWith("decimate: error: " + mesh_.string() +
                                  ": the mesh is 1e+04 mm wide, expected 0.5 mm to 500 mm; is the unit right?\n"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/decimate.yaml"));
  object_ = scratch_.file("object.yaml", "unit: feet\nup: z\n");
  EXPECT_EQ(run("out"), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("object.yaml:1:7: unit: "));
  EXPECT_THAT(said_, ::testing::HasSubstr("object.yaml:2:5: up: "));
}

}  // namespace
}  // namespace tacipc
