#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/base/error.h"
#include "stages/study/cases/case_files.h"
#include "tests/config_text.h"
#include "tests/program_test.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace cases_test {

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
    calibrates: block_b
    images: [{name: block_a, depth_mm: 0.25}, {name: block_b, depth_mm: 0.5}]
)";

std::string file(const std::string& name) {
  for (const auto& [path, content] : case_files(config_from_text<BenchmarkCases>(kCases, "c.yaml"), "configs/study"))
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
  EXPECT_EQ(
      file("known_objects.yaml"),
      "objects:\n  - {name: block, photograph: block_b_real.png, frame: 2, center_px: [20.5, 16], box_px: [0, 0, 10, "
      "10], yaw: true}\n");
  const std::string variables = file("cases.mk");
  EXPECT_THAT(variables, testing::HasSubstr("CASES_KNOWN := block\n"));
  EXPECT_THAT(variables, testing::HasSubstr("CASES_KNOWN_FRAME_block := 2\n"));
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
                           testing::HasSubstr("objects[1].fit.image: is not one of the images")));
}

const std::string kCircleCases = R"(title: circles
data: shots
photographs: .
ending: /shot.png
circles: found.csv
circle_table: {image: name, diameter_mm: d, x_px: x, y_px: y, radius_px: r, leave_out: cut, calibrate_every: 2,
  box_radii: 1.5, background_radii: 2, image_px: [100, 80]}
sensor: s.yaml
mesh: m.yaml
press: p.yaml
calibrate: c.yaml
baseline: b.yaml
calibration_ball: {radius_mm: 3, deepest_mm: 1.25, steps: 25}
ball_edge_mm: 0.25
mesh_spacing_mm: 0.1
)";

BenchmarkCases with_circles(const std::filesystem::path& table) {
  auto cases = config_from_text<BenchmarkCases>(kCircleCases, "c.yaml");
  add_circles(cases, table);
  return cases;
}

TEST(Circles, EverySecondCalibratesAndTheOthersAreTested) {
  const ScratchFolder scratch;
  const auto table = scratch.file("found.csv",
                                  "name,d,x,y,r,cut\r\n6mm/0,6,20,30,10,0\n6mm/1,6,50.5,40,10,0\n6mm/2,6,5,5,9,1\n"
                                  "4mm/0,4,50,40,8,0\n6mm/3,6.0,60,50,12.5,0\n6mm/4,6,94,8,8,0\n");
  const BenchmarkCases cases = with_circles(table);
  ASSERT_EQ(cases.objects.size(), 1u);
  ASSERT_EQ(cases.objects[0].images.size(), 2u);
  EXPECT_EQ(cases.objects[0].images[0].box_px, (std::array{36, 25, 31, 31}));
  EXPECT_EQ(cases.objects[0].images[1].box_px, (std::array{82, 0, 18, 21}));  // cut at the photograph's border
  const auto files = case_files(cases, "configs");
  const auto content = [&](const std::string& name) {
    for (const auto& [path, text] : files)
      if (path == name) return text;
    return std::string("not made");
  };
  EXPECT_EQ(content("labels.txt"), "6mm/0/shot.png (20, 30) 10\n6mm/3/shot.png (60, 50) 12.5\n");
  EXPECT_EQ(content("background.yaml"), "contact_radii: 2\n");
  EXPECT_EQ(content("objects/ball/shade.yaml"),
            "images:\n  - {name: 6mm_1, center_px: [50.5, 40], contact_px: 10}\n"
            "  - {name: 6mm_4, center_px: [94, 8], contact_px: 8}\nball: {radius_mm: 3}\n");
  EXPECT_EQ(content("objects/ball/motion.yaml"), "not made");
  EXPECT_THAT(content("metrics.yaml"), testing::HasSubstr("{starts_with: 6mm_1.png, px: [36, 25, 31, 31]}"));
  EXPECT_THAT(content("cases.mk"), testing::HasSubstr("CASES_CIRCLES := shots/found.csv\n"));
  EXPECT_THAT(content("cases.mk"), testing::HasSubstr("CASES_PHOTOGRAPH_6mm_1 := shots/./6mm/1/shot.png\n"));
}

TEST(Circles, FaultsOfTheTableAreSaid) {
  const ScratchFolder scratch;
  const auto said = [&](const std::string& text) {
    const auto table = scratch.file("t.csv", text);
    const std::string message = message_of<DataError>([&] { with_circles(table); });
    return message.starts_with(table.string()) ? message.substr(table.string().size()) : message;
  };
  const std::string header = "name,d,x,y,r,cut\n";
  EXPECT_EQ(said("name,d,x,y,r\n"), ": has no column cut");
  EXPECT_EQ(said(header), ": has no row of a ball of radius 3.0000 mm that counts");
  EXPECT_EQ(said(header + "a,6,1,2,3,0\n"), ": leaves no photograph to test");
  EXPECT_EQ(said(header + "a,6,1,2,3\n"), ":2: has 5 fields, the header 6");
  EXPECT_EQ(said(header + "a,6,1,2,3px,0\n"), ":2: r: '3px' is not a number");
  EXPECT_EQ(said(header + "a,6,1,2,0,0\n"), ":2: the radius must be positive");
  EXPECT_EQ(said(header + "a,6,1,2,3,0\na,6,1,2,3,0\n"), ":3: a is given twice");
  EXPECT_EQ(said(header + "a b,6,1,2,3,0\n"), ":2: 'a b' has characters other than letters, digits and . _ / + -");
  EXPECT_EQ(said(header + "a,6,1,2,3,0\nb,6,500,2,3,0\n"), ": the circle of b lies outside the photograph");
  auto plain = config_from_text<BenchmarkCases>(kCases, "c.yaml");
  EXPECT_EQ(message_of<UsageError>([&] { add_circles(plain, scratch / "t.csv"); }),
            "--circles: the benchmark names no circles");
}

class CasesProgram : public ProgramTest {};

TEST_F(CasesProgram, TheShippedBenchmarkIsRead) {
  ASSERT_EQ(
      run_command(fmt::format(
          "cd {} && {}/cases --config configs/studies/sim2real/gelsight_sim2real.yaml --out '{}' --log-level error",
          TACIPC_SOURCE_DIR, TACIPC_BIN_DIR, (scratch_ / "out").string())),
      0)
      << said_;
  EXPECT_THAT(read_file(scratch_ / "out/cases.mk"),
              testing::HasSubstr("CASES_SENSOR := configs/sensors/gelsight_lab.yaml\n"));
  EXPECT_THAT(read_file(scratch_ / "out/cases.yaml"), testing::HasSubstr("images: 8\n"));
}

}  // namespace cases_test
}  // namespace tacipc
