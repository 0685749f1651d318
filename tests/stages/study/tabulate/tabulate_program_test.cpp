#include <fmt/core.h>
#include <gmock/gmock.h>

#include "common/image/image.h"
#include "tests/program_test.h"
#include "tests/stages/study/tabulate/small_table.h"

namespace tacipc {
namespace tabulate_program_test {

using TabulateProgram = ProgramTest;

TEST_F(TabulateProgram, WritesTablesAndSheetsAndNeedsTheirPictures) {
  samples_of(scratch_, "a");
  samples_of(scratch_, "b");
  write_png(scratch_ / "a/x.png", ByteImage(16, 12, 3, 90));
  scratch_.file("t.yaml", "kind: images\n" + kSmallTable +
                              "link_folder: pictures\nsheets: [{name: s, alt: x, picture_px: 20, columns: "
                              "[{heading: A, method: a}]}]\n");
  const std::string run = fmt::format(
      "cd '{}' && {}/tabulate --config t.yaml --log-level error --out out --samples a=a/samples.csv "
      "b=b/samples.csv",
      (scratch_ / "").string(), TACIPC_BIN_DIR);
  EXPECT_EQ(run_command(run), 1);
  EXPECT_EQ(said_, "tabulate: error: sheet s: 0 pictures of a, 0 of a\n");
  ASSERT_EQ(run_command(run + " --pictures a=a/x.png"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/table.md"), testing::HasSubstr("![x](pictures/s.png)"));
  EXPECT_THAT(read_file(scratch_ / "out/table.csv"), testing::HasSubstr("first,,box,psnr_ln,2,1,25,5,"));
  EXPECT_EQ(read_png(scratch_ / "out/pictures/s.png", 3).width, 28);
  EXPECT_THAT(read_file(scratch_ / "out/tabulate.yaml"), testing::HasSubstr("summary:\n  rows: 2\n  images: 2\n"));
}

TEST_F(TabulateProgram, FlagsBelongToKinds) {
  samples_of(scratch_, "a");
  scratch_.file("costs.yaml", "kind: costs\ntitle: t\nrows: [{name: a, stage: press, per: x}]\n");
  const std::string run =
      fmt::format("cd '{}' && {}/tabulate --config costs.yaml --out out", (scratch_ / "").string(), TACIPC_BIN_DIR);
  EXPECT_EQ(run_command(run), 2);
  EXPECT_EQ(said_, "tabulate: error: --timings: is required for a table of kind costs\n");
  EXPECT_EQ(run_command(run + " --samples a=a/samples.csv"), 2);
  EXPECT_EQ(said_, "tabulate: error: --samples: is not for a table of kind costs\n");
}

TEST_F(TabulateProgram, ComparesWithPhotographs) {
  scratch_.file("c.yaml", "kind: comparison\nrows: [{name: ours, method: a}, {name: a rival, method: b}]\n");
  scratch_.file("benchmark.yaml", R"(title: shots
data: shots
background: bg.png
photographs: images
labels: balls.txt
ending: .png
sensor: s.yaml
mesh: m.yaml
press: p.yaml
calibrate: c.yaml
baseline: b.yaml
calibration_ball: {radius_mm: 3.0, deepest_mm: 1.3, steps: 26}
ball_edge_mm: 0.25
mesh_spacing_mm: 0.05
objects:
  - name: ball
    ball_radius_mm: 3.0
    center_px: [20, 16]
    box_px: [10, 10, 8, 8]
    fit: {image: y, yaw: false}
    images: [{name: x, depth_mm: 0.25}, {name: y, depth_mm: 0.5}]
)");
  for (const std::string method : {"a", "b"})
    scratch_.file(method + ".csv",
                  "name,region,mae,psnr_db,ssim_w,ssim_s\nx.png,full,0.1,20,0.5,0.5\n"
                  "x.png,box,0.1,20,0.5,0.5\ny.png,full,0.1,20,0.5,0.5\ny.png,box,0.1," +
                      std::string(method == "a" ? "30" : "20") + ",0.5,0.5\n");
  std::string pictures;
  for (const std::string method : {"photograph", "a", "b"}) {
    write_png(scratch_ / (method + ".png"), ByteImage(40, 30, 3, 90));
    for (int i = 0; i < 2; ++i) pictures += " " + method + "=" + method + ".png";
  }
  const std::string run = fmt::format(
      "cd '{}' && {}/tabulate --config c.yaml --benchmark benchmark.yaml --samples b=b.csv a=a.csv --log-level error "
      "--out out --pictures",
      (scratch_ / "").string(), TACIPC_BIN_DIR);
  ASSERT_EQ(run_command(run + pictures), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/table.md"),
              testing::HasSubstr("| ours | 0.500 | 0.500 | 0.1000 | 25.00 | 0.500 | 0.500 | 0.1000 | 20.00 |\n"));
  EXPECT_THAT(read_file(scratch_ / "out/tabulate.yaml"),
              testing::HasSubstr("summary:\n  holds: false\n  musts: true\n  ahead: false\n  ours:\n    box:\n"));
  EXPECT_EQ(read_png(scratch_ / "out/sheet.png", 3).height, 4 + 2 * (30 + 4));  // the whole height
  EXPECT_EQ(run_command(run + " photograph=a.png a=a.png b=b.png"), 2);
  EXPECT_EQ(said_, "tabulate: error: --pictures: 1 of photograph, the benchmark has 2 images\n");
}

}  // namespace tabulate_program_test
}  // namespace tacipc
