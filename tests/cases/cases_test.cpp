#include <fmt/core.h>
#include <gmock/gmock.h>

#include "stages/cases/case_files.h"
#include "tests/config_text.h"
#include "tests/program_test.h"

namespace tacipc {
namespace {

const std::string kCases = R"(title: two
data: shots
background: bg.png
photographs: images
labels: balls.txt
ending: _real.png
sensor: s.yaml
mesh: ../m.yaml
press: p.yaml
calibrate: c.yaml
baseline: b.yaml
calibration_ball: {radius_mm: 3, deepest_mm: 1.25, steps: 25}
ball_edge_mm: 0.25
mesh_spacing_mm: 0.1
must: {ssim_s: 0.8, mae: 0.03, psnr_db: 28}
objects:
  - name: ball
    ball_radius_mm: 3
    center_px: [20, 16]
    box_px: [1, 2, 30, 40]
    fit: {image: ball_1, yaw: false}
    images: [{name: ball_1, depth_mm: 0.5}]
  - name: block
    mesh: block.stl
    unit: mm
    edge_radius_mm: 0.25
    center_px: [20.5, 16]
    box_px: [0, 0, 10, 10]
    fit: {image: block_b, yaw: true}
    images: [{name: block_a, depth_mm: 0.25}, {name: block_b, depth_mm: 0.5}]
)";

std::string file(const std::string& name) {
  for (const auto& [path, content] :
       case_files(config_from_text<BenchmarkCases>(kCases, "c.yaml"), "configs/benchmarks"))
    if (path == name) return content;
  return "not made";
}

TEST(CaseFiles, SayWhatEachStageNeeds) {
  EXPECT_EQ(file("objects/block/motion.yaml"),
            "motion:\n  - {kind: press, depth_mm: 0.25, steps: 1, substeps: 2}\n"
            "  - {kind: press, depth_mm: 0.5, steps: 1, substeps: 2}\n");
  EXPECT_EQ(file("objects/block/indenter.yaml"),
            "mesh: {unit: mm, edge_radius_mm: 0.25, spacing_mm: 0.1, relief_mm: 1.5}\n");
  EXPECT_EQ(file("objects/ball/indenter.yaml"), "ball: {radius_mm: 3, edge_mm: 0.25}\n");
  EXPECT_EQ(file("objects/block/shade.yaml"),
            "images:\n  - {name: block_a, frame: 1}\n  - {name: block_b, frame: 2}\nplace: {center_px: [20.5, 16]}\n"
            "fit: {image: block_b, box_px: [0, 0, 10, 10], yaw: true}\n");
  EXPECT_THAT(file("metrics.yaml"), testing::HasSubstr("{starts_with: block/block_b.png, px: [0, 0, 10, 10]}"));
  const std::string variables = file("cases.mk");
  EXPECT_THAT(variables, testing::HasSubstr("CASES_OBJECTS := ball block\n"));
  EXPECT_THAT(variables, testing::HasSubstr("CASES_MESH := configs/m.yaml\n"));
  EXPECT_THAT(variables, testing::HasSubstr("CASES_MESH_block := shots/block.stl\n"));
  EXPECT_THAT(variables, testing::HasSubstr("CASES_IMAGES_block := block_a block_b\n"));
}

TEST(Cases, FaultsAreAllSaidAtTheirPlace) {
  std::string text = kCases;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("background: bg.png", "background: \"b g.png\"");
  replace("mesh: block.stl", "ball_radius_mm: 3\n    mesh: block.stl");
  replace("depth_mm: 0.5}]\n  - name: block", "depth_mm: 0.5}, {name: ball_1, depth_mm: 0.4}]\n  - name: block");
  replace("image: block_b, yaw", "image: block_c, yaw");
  EXPECT_THAT(
      faults_in<BenchmarkCases>(text, "c.yaml"),
      testing::ElementsAre("c.yaml:3:13: background: has characters other than letters, digits and . _ / + -",
                           testing::HasSubstr("objects[0].images[1].name: is given twice"),
                           testing::HasSubstr("objects[0].images[1].depth_mm: must be deeper than the image before"),
                           testing::HasSubstr("objects[1].mesh: give either ball_radius_mm or mesh"),
                           testing::HasSubstr("objects[1].fit.image: is none of the images")));
}

class CasesProgram : public ProgramTest {};

TEST_F(CasesProgram, TheShippedBenchmarkIsRead) {
  ASSERT_EQ(run_command(fmt::format(
                "cd {} && {}/cases --config configs/benchmarks/gelsight_sim2real.yaml --out '{}' --log-level error",
                TACIPC_SOURCE_DIR, TACIPC_BIN_DIR, (scratch_ / "out").string())),
            0)
      << said_;
  EXPECT_THAT(read_file(scratch_ / "out/cases.mk"),
              testing::HasSubstr("CASES_SENSOR := configs/benchmarks/gelsight_sim2real/sensor.yaml\n"));
  EXPECT_THAT(read_file(scratch_ / "out/cases.yaml"), testing::HasSubstr("images: 8\n"));
}

}  // namespace
}  // namespace tacipc
