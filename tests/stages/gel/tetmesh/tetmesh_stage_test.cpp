// The program itself: files, records, exit codes, messages.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "common/base/files.h"
#include "common/mesh/tet_mesh.h"
#include "tests/program_test.h"
#include "tests/stages/gel/tetmesh/gels.h"

namespace tacipc {
namespace tetmesh_stage_test {

using ::testing::HasSubstr;

class TetmeshStageTest : public ProgramTest {
 protected:
  int run(const std::string& config, const std::string& more = "",
          const std::string& sensor = config_path("sensors/mctac.yaml")) {
    const int code = run_command(fmt::format("{}/tetmesh --log-level warning --config {} --sensor {} --out {} {} > {}",
                                             TACIPC_BIN_DIR, config, sensor, (scratch_ / "out").string(), more,
                                             (scratch_ / "stdout.txt").string()));
    EXPECT_EQ(read_file(scratch_ / "stdout.txt"), "");
    return code;
  }
};

TEST_F(TetmeshStageTest, GivesTheSameBytesTwiceAtAnyThreadCount) {
  const std::string tiny = config_path("gels/tiny.yaml");
  ASSERT_EQ(run(tiny, "--threads 1"), 0) << said_;
  EXPECT_EQ(said_, "");
  const std::string mesh = read_file(scratch_ / "out/gel.msh"), record = read_file(scratch_ / "out/tetmesh.yaml");
  ASSERT_EQ(run(tiny, "--threads 3"), 0) << said_;
  EXPECT_EQ(read_file(scratch_ / "out/gel.msh"), mesh);
  EXPECT_EQ(read_file(scratch_ / "out/tetmesh.yaml"), record);
  const TetMesh gel = read_tet_mesh(scratch_ / "out/gel.msh");
  const TetMesh made = generate_gel(mctac_gel(), preset("tiny"));
  EXPECT_EQ(gel.positions, made.positions);
  EXPECT_EQ(gel.tets, made.tets);
  EXPECT_THAT(record, HasSubstr(fmt::format("summary:\n  vertices: {}\n", gel.num_vertices())));
  EXPECT_THAT(record, HasSubstr("analytic_volume_mm3: 1414"));
}

TEST_F(TetmeshStageTest, ImportsWhatItMade) {
  ASSERT_EQ(run(config_path("gels/tiny.yaml")), 0) << said_;
  const Positions made = read_tet_mesh(scratch_ / "out/gel.msh").positions;
  std::filesystem::rename(scratch_ / "out/gel.msh", scratch_ / "finished.msh");
  std::string config = read_file(config_path("gels/import_paper.yaml"));
  config.replace(config.find("rotation_deg: 180"), 17, "rotation_deg: 0");
  const std::string path = scratch_.file("import.yaml", config);
  ASSERT_EQ(run(path, "--import " + (scratch_ / "finished.msh").string()), 0) << said_;
  EXPECT_EQ(read_tet_mesh(scratch_ / "out/gel.msh").positions, made);
  EXPECT_THAT(read_file(scratch_ / "out/tetmesh.yaml"), HasSubstr("summary:\n  tets_turned: false\n"));
}

TEST_F(TetmeshStageTest, KindAndFlagMustAgree) {
  EXPECT_EQ(run(config_path("gels/import_paper.yaml")), 2);
  EXPECT_THAT(said_, HasSubstr("--config says kind: import, so --import is needed"));
  EXPECT_EQ(run(config_path("gels/tiny.yaml"), "--import " + config_path("gels/tiny.yaml").string()), 2);
  EXPECT_THAT(said_, HasSubstr("--import needs a --config with kind: import"));
}

TEST_F(TetmeshStageTest, UnknownShapeAndTooFineSizingAreRefused) {
  EXPECT_EQ(run(scratch_.file("odd.yaml", "kind: grow\n")), 2);
  EXPECT_THAT(said_, HasSubstr("odd.yaml:1:7: kind: "));
  std::string config = read_file(config_path("gels/uniform_0250um.yaml"));
  config.replace(config.find("uniform_mm: 0.25"), 16, "uniform_mm: 0.05");
  EXPECT_EQ(run(scratch_.file("fine.yaml", config)), 1);
  EXPECT_THAT(said_, HasSubstr("the sizing asks for about 1.62e+07 vertices, more than max_vertices 2e+06"));
  EXPECT_THAT(said_, HasSubstr((scratch_ / "fine.yaml").string() + " with the gel of "));
  EXPECT_THAT(said_, HasSubstr("sensors/mctac.yaml: the sizing asks for"));
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/tetmesh.yaml"));
}

TEST_F(TetmeshStageTest, SizesBeyondAnySensorAreRefusedAtTheirPlace) {
  const std::string shipped = read_file(config_path("sensors/mctac.yaml"));
  const auto refused = [&](const std::string& key, const std::string& by, const std::string& message) {
    std::string text = shipped;
    const std::size_t at = text.find("  " + key);
    text.replace(at, text.find('\n', at) - at, by);
    EXPECT_EQ(run(config_path("gels/tiny.yaml"), "", scratch_.file("odd.yaml", text)), 2) << by;
    EXPECT_THAT(said_, HasSubstr("odd.yaml:")) << by;
    EXPECT_THAT(said_, HasSubstr(message)) << by;
  };
  refused("radius_mm:", "  radius_mm: 1.0e+300", ":14: gel.radius_mm: 1.0e+300 is outside [0.001, 10000]");
  refused("thickness_mm:", "  thickness_mm: 1.0e-200", ": gel.thickness_mm: 1.0e-200 is outside [0.001, 10000]");
  const std::size_t outline = shipped.find("outline: disc");
  ASSERT_NE(outline, std::string::npos);
  std::string rectangle = shipped;
  rectangle.replace(outline, 13, "outline: rectangle");
  const std::size_t radius = rectangle.find("radius_mm: 15.0");
  rectangle.replace(radius, 15, "size_mm: [1000000, 24]");
  EXPECT_EQ(run(config_path("gels/tiny.yaml"), "", scratch_.file("wide.yaml", rectangle)), 2);
  EXPECT_THAT(said_, HasSubstr(": gel.size_mm[0]: 1000000 is outside [0.001, 10000]"));
  rectangle.replace(radius, 22, "size_mm: [2500, 24]");
  EXPECT_EQ(run(config_path("gels/tiny.yaml"), "", scratch_.file("wide.yaml", rectangle)), 2);
  EXPECT_THAT(said_, HasSubstr(": gel.size_mm: one side is more than 100 times the other"));
  std::string import = read_file(config_path("gels/import_paper.yaml"));
  import.replace(import.find("translation_mm: [0,"), 19, "translation_mm: [1.0e+300,");
  EXPECT_EQ(run(scratch_.file("far.yaml", import), "--import " + scratch_.file("any.msh", "").string()), 2);
  EXPECT_THAT(said_, HasSubstr("far.yaml:"));
  EXPECT_THAT(said_, HasSubstr(": transform.translation_mm[0]: 1.0e+300 is outside [-1000000, 1000000]"));
}

}  // namespace tetmesh_stage_test
}  // namespace tacipc
