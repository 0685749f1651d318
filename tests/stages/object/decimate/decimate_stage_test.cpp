// The program as a user runs it.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/program_test.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace decimate_stage_test {

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
                                  ": the mesh is 1e+04 mm wide, expected 0.5 mm to 500 mm; is the unit right? (in mm "
                                  "it is 10 mm wide)\n"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/decimate.yaml"));
  object_ = scratch_.file("object.yaml", "unit: feet\nup: z\n");
  EXPECT_EQ(run("out"), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("object.yaml:1:7: unit: "));
  EXPECT_THAT(said_, ::testing::HasSubstr("object.yaml:2:5: up: "));
}

TEST_F(DecimateStage, TakesTheUnitOfFormatOrNameAndScales) {
  const auto extent_mm = [&](const std::string& out) {
    const Positions p = read_triangle_mesh(scratch_ / out / "object.ply", 1.0).positions;
    return 1e3 * (p.col(0).maxCoeff() - p.col(0).minCoeff());
  };
  object_ = scratch_.file("auto.yaml", "unit: auto\nscale: 0.5\n");
  mesh_ = scratch_ / "ball_cm.ply";
  write_ply(mesh_, sphere(0.5, 2));
  ASSERT_EQ(run("named"), 0) << said_;
  EXPECT_NEAR(extent_mm("named"), 5.0, 1e-9);
  EXPECT_THAT(read_file(scratch_ / "named/decimate.yaml"),
              ::testing::HasSubstr("  unit: cm\n  unit_from: file name\n  scale: 0.5\n"));
  // A tetrahedron of 10 mm as glTF, whose lengths are metres, twice as wide by its node.
  const std::string positions = "AAAAAAAAAAAAAAAACtcjPAAAAAAAAAAAAAAAAArXIzwAAAAAAAAAAAAAAAAK1yM8";  // 0 and 0.01
  object_ = scratch_.file("as_is.yaml", "unit: auto\n");
  mesh_ = scratch_.file(
      "tetrahedron.gltf",
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[2,1,1]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"buffers":[{"byteLength":72,"uri":)"
      R"("data:application/octet-stream;base64,)" +
          positions +
          R"(AAACAAEAAAABAAMAAAADAAIAAQACAAMA"}],"bufferViews":[{"buffer":0,"byteLength":48},)"
          R"({"buffer":0,"byteOffset":48,"byteLength":24}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,)"
          R"("type":"VEC3","min":[0,0,0],"max":[0.01,0.01,0.01]},{"bufferView":1,"componentType":5123,"count":12,"type":)"
          R"("SCALAR"}]})");
  ASSERT_EQ(run("gltf"), 0) << said_;
  EXPECT_NEAR(extent_mm("gltf"), 20.0, 1e-5);
  EXPECT_NEAR(1e9 * signed_volume(read_triangle_mesh(scratch_ / "gltf/object.ply", 1.0)), 2000.0 / 6.0, 1e-3);
  EXPECT_THAT(read_file(scratch_ / "gltf/decimate.yaml"), ::testing::HasSubstr("unit_from: mesh format\n"));
  mesh_ = scratch_.file("broken.glb", "glTF, but no more");
  EXPECT_EQ(run("broken"), 1);
  EXPECT_THAT(said_, ::testing::HasSubstr("broken.glb: is binary glTF of version "));
}

TEST_F(DecimateStage, FitsTheSensorsWindow) {
  object_ = scratch_.file("fit.yaml", "unit: m\nscale: fit\n");
  write_ply(mesh_, sphere(5.0, 2));
  EXPECT_EQ(run("alone"), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("scale: fit needs --sensor"));
  ASSERT_EQ(run(fmt::format("fit --sensor {}/configs/sensors/mctac.yaml", TACIPC_SOURCE_DIR)), 0) << said_;
  const Positions p = read_triangle_mesh(scratch_ / "fit/object.ply", 1.0).positions;
  EXPECT_NEAR(1e3 * (p.col(1).maxCoeff() - p.col(1).minCoeff()), 0.9 * 11.25, 1e-6);
}

}  // namespace decimate_stage_test
}  // namespace tacipc
