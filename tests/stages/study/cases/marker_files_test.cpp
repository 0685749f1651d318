#include "stages/study/cases/case_files.h"

#include <gmock/gmock.h>

#include <map>

#include "tests/config_text.h"
#include "tests/program_test.h"

namespace tacipc {
namespace marker_files_test {

const std::string kBenchmark = R"(title: shots
data: shots
fields:
  press: a.csv
  shear: b.csv
  remove_press_median: true
  remove_shear_median: false
  image_px: [320, 240]
  px_per_mm: 20
  contact_px: [150, 130]
  shear_marker_px: [141, 147]
  least_length_px: 2.0
ball: {radius_mm: 2.35, edge_mm: 0.15}
friction: 0.7
sensor: s.yaml
mesh: ../m.yaml
press: p.yaml
runs: {shallowest_mm: 0.6, deepest_mm: 1.8, depths: 3, press_step_mm: 0.1, shear_mm: 1.4, shear_steps: 14, direction_deg: 90}
variants:
  - {name: smooth, friction: 0}
  - {name: wide, ball_radius_mm: 3.0}
  - {name: scaled, px_per_mm: 18.8}
  - {name: thick, gel_thickness_mm: 7.5}
)";

TEST(MarkerFiles, SayWhatEachStageNeeds) {
  std::map<std::string, std::string> files;
  for (const auto& [name, content] :
       marker_files(config_from_text<MarkerBenchmark>(kBenchmark, "b.yaml"), "configs/study"))
    files[name] = content;
  EXPECT_EQ(files["motion_1200um.yaml"],
            "placement: {center_mm: [-0.5, 0.5]}\nmotion:\n  - {kind: press, depth_mm: 1.2, steps: 12}\n"
            "  - {kind: shear, direction_deg: 90, distance_mm: 1.4, steps: 14}\n");
  EXPECT_EQ(files["base/indenter.yaml"], "ball: {radius_mm: 2.35, edge_mm: 0.15}\n");
  EXPECT_EQ(files["base/friction.yaml"],
            "friction: {coefficient: 0.7, relative_speed_threshold: 1.0e-3, lag: iterated}\n");
  EXPECT_EQ(files["smooth/friction.yaml"], "");
  EXPECT_EQ(files["wide/indenter.yaml"], "ball: {radius_mm: 3, edge_mm: 0.15}\n");
  EXPECT_FALSE(files.contains("scaled/indenter.yaml"));  // the base's presses serve
  EXPECT_EQ(files["cases.mk"],
            "# Made by the stage cases.\nMARKERS_PRESSED := shots/a.csv\nMARKERS_SHEARED := shots/b.csv\n"
            "MARKERS_SENSOR := configs/study/s.yaml\nMARKERS_MESH := configs/m.yaml\n"
            "MARKERS_PRESS := configs/study/p.yaml\nMARKERS_DEPTHS := 0600um 1200um 1800um\n"
            "MARKERS_VARIANTS := base smooth wide thick\n"
            "MARKERS_THICKNESS_MM_thick := 7.5\n");
}

class MarkerCases : public ProgramTest {};

TEST_F(MarkerCases, TheProgramTellsBothKindsOfBenchmarkApart) {
  scratch_.file("b.yaml", kBenchmark);
  const std::string command = "cd '" + (scratch_ / "").string() + "' && " + TACIPC_BIN_DIR +
                              "/cases --log-level error --config b.yaml --out out";
  ASSERT_EQ(run_command(command), 0) << said_;
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/wide/indenter.yaml"));
  EXPECT_EQ(run_command(command + " --circles b.yaml"), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("--circles: the benchmark names no circles"));
  scratch_.file("b.yaml", "title: x\n");
  EXPECT_EQ(run_command(command), 2);
  EXPECT_THAT(said_, ::testing::HasSubstr("b.yaml:1:1: photographs: missing"));
}

// The shipped benchmark and what it names are readable.
TEST(MarkerFiles, TheShippedBenchmarkIsWhole) {
  const std::filesystem::path source = TACIPC_SOURCE_DIR;
  const auto benchmark = read_config<MarkerBenchmark>(source / "configs/studies/fots/fots_markers.yaml");
  for (const std::string& path : {benchmark.sensor, benchmark.mesh, benchmark.press})
    EXPECT_TRUE(std::filesystem::exists(source / "configs/studies/fots" / path)) << path;
  EXPECT_EQ(benchmark.depths_m().size(), 6u);
}

}  // namespace marker_files_test
}  // namespace tacipc
