#include "stages/study/tabulate/mesh_costs.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/program_test.h"

namespace tacipc {
namespace mesh_costs_test {

using ::testing::HasSubstr;

const char* const kConfig = R"(kind: meshes
title: Gels
link_folder: pictures
families:
  - {name: even, meshes: [{name: even_1}, {name: even_2}]}
  - {name: graded, meshes: [{name: graded_1, remark: ours}, {name: graded_2}]}
)";

class MeshTable : public ProgramTest {
 protected:
  void SetUp() override {
    write_file(scratch_ / "config.yaml", kConfig);
    write("even_1", 10000, 0.02);
    write("even_2", 80000, 0.01);
    write("graded_1", 1000, 0.04);
    write("graded_2", 4000, 0.01);
  }
  void write(const std::string& mesh, int vertices, double error) {
    write_file(scratch_ / ("gels/mctac-" + mesh + "/tetmesh.yaml"),
               fmt::format("stage: tetmesh\nsummary:\n  vertices: {}\n  tets: {}\n", vertices, 5 * vertices));
    write_file(scratch_ / ("depth/" + mesh + "/metrics.yaml"),
               fmt::format("stage: metrics\nsummary:\n  pressed:\n    mae_mm: {{mean: {}}}\n    max_mm: {{mean: {}}}\n",
                           error, 8 * error));
    for (const std::string object : {"star", "gear"}) {
      const std::string folder = "runs/" + mesh + "/" + object;
      for (const std::string stage : {"press", "render"}) {
        write_file(scratch_ / (folder + "/" + stage + "/" + stage + ".yaml"), "stage: " + stage + "\n");
        write_file(scratch_ / (folder + "/" + stage + "/" + stage + ".timings.yaml"),
                   fmt::format("stage: {}\nwall_s: 50\nprocessor_s: {}\npeak_memory_mb: {}\n", stage,
                               object == "star" ? 2.0 : 4.0, vertices / 100.0));
      }
    }
  }
  int run() {
    return run_command(
        fmt::format("cd '{}' && for m in even_1 even_2 graded_1 graded_2; do for f in gels/mctac-$m/tetmesh.yaml "
                    "runs/$m/*/press/press.yaml runs/$m/*/render/render.yaml depth/$m/metrics.yaml; do [ ! -e $f ] || "
                    "echo $m=$f; done; done "
                    "> records && "
                    "{}/tabulate --config config.yaml --records $(cat records) --log-level error --out out",
                    (scratch_ / "").string(), TACIPC_BIN_DIR));
  }
};

TEST_F(MeshTable, MeshesBesideEachOther) {
  ASSERT_EQ(run(), 0) << said_;
  const std::string table = read_file(scratch_ / "out/table.md");
  EXPECT_THAT(table, HasSubstr("| graded_1 | ours | 1,000 | 5,000 | 3.0 | 3.0 | 0.01 | 0.0400 | 0.320 |\n"));
  EXPECT_THAT(table, HasSubstr("Gels: means over 2 presses"));
  // Half way in the logarithm of the error is half way in that of the vertices: √(1000 · 4000).
  EXPECT_THAT(table,
              HasSubstr("- even_1 (10,000 vertices, 0.0200 mm): a mesh of the graded kind has that error with some "
                        "2,000 vertices, 5.0 times fewer\n"));
  EXPECT_THAT(table,
              HasSubstr("- even_2 (80,000 vertices, 0.0100 mm): a mesh of the graded kind has that error with some "
                        "4,000 vertices, 20.0 times fewer\n"));
  EXPECT_THAT(table, HasSubstr("(pictures/mesh_error.svg)"));
  const std::string plot = read_file(scratch_ / "out/pictures/mesh_error.svg");
  EXPECT_THAT(plot, HasSubstr("graded"));
  EXPECT_THAT(read_file(scratch_ / "out/table.csv"), HasSubstr("even,even_2,80000,400000,2,3,3,800,0.01,0.08\n"));
}

TEST_F(MeshTable, ErrorsNobodyReachesAreSaid) {
  write("even_2", 80000, 0.005);
  write("even_1", 10000, 0.05);
  ASSERT_EQ(run(), 0) << said_;
  const std::string table = read_file(scratch_ / "out/table.md");
  EXPECT_THAT(table, HasSubstr("even_2 (80,000 vertices, 0.0050 mm): no mesh of the graded kind comes so near\n"));
  EXPECT_THAT(table,
              HasSubstr("even_1 (10,000 vertices, 0.0500 mm): graded_1 is nearer (0.0400 mm) with 1,000 vertices, 10.0 "
                        "times fewer\n"));
}

TEST_F(MeshTable, AKindThatNeedsMoreIsSaidToNeedMore) {
  write("graded_1", 40000, 0.02);
  write("graded_2", 400000, 0.01);
  ASSERT_EQ(run(), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/table.md"), HasSubstr("with some 40,000 vertices, 4.0 times more\n"));
}

TEST_F(MeshTable, EveryMeshNeedsItsFiles) {
  std::filesystem::remove_all(scratch_ / "depth/even_2");
  EXPECT_EQ(run(), 1);
  EXPECT_EQ(said_, "tabulate: error: no record of metrics was given for even_2\n");
}

}  // namespace mesh_costs_test
}  // namespace tacipc
