#include "stages/study/tabulate/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/error.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace comparison_test {

BenchmarkCases cases() {
  BenchmarkCases out;
  out.title = "photographs";
  out.must = {0.8, 0.03, 28.0};
  ObjectCase object;
  object.name = "ball";
  object.fit_image = "ball_b";
  object.images = {{"ball_a", 1e-3}, {"ball_b", 2e-3}};
  out.objects = {object};
  return out;
}

const std::string kHeader = "name,region,mae,mse,psnr_db,psnr_ln,ssim_w,ssim_s\n";

const ComparisonConfig kOursAlone{.rows = {{.name = "ours", .method = "a", .group = ""}}};

TEST(Comparison, ShowsTheImagesOfTheBenchmarkInItsOrder) {
  const ScratchFolder scratch;
  const auto file = scratch.file(
      "s.csv", kHeader +
                   "ball/ball_b.png,full,0.1,0,20,0,0.5,0.6\nball/ball_b.png,box,0.2,0,10,0,0.4,0.5\n"
                   "ball/ball_a.png,full,0.01,0,30,0,0.9,0.95\nball/ball_a.png,box,0.02,0,25,0,0.8,0.85\n");
  EXPECT_THAT(to_markdown(read_comparison({{"a", file}}, kOursAlone, cases()), cases()),
              testing::EndsWith("| image, in the box | ours: SSIM-S | SSIM-W | MAE | PSNR dB |\n|---|---|---|---|---|\n"
                                "| ball_a | 0.850 | 0.800 | 0.0200 | 25.00 |\n"
                                "| ball_b (fitted place) | 0.500 | 0.400 | 0.2000 | 10.00 |\n"));
  BenchmarkCases calibrated = cases();
  calibrated.objects[0].calibrates = "ball_b";
  const std::string page = to_markdown(read_comparison({{"a", file}}, kOursAlone, calibrated), calibrated);
  EXPECT_THAT(page, testing::HasSubstr("| ours | 0.850 | 0.800 | 0.0200 | 25.00 | 0.950 | 0.900 | 0.0100 | 30.00 |\n"));
  EXPECT_THAT(page, testing::HasSubstr("Means over 1 photographs"));
  EXPECT_THAT(page, testing::EndsWith("| ball_b (calibrates, place; in no mean) | 0.500 | 0.400 | 0.2000 | 10.00 |\n"));
  const auto said = [&](const std::string& images) {
    std::string text = kHeader;
    for (const char image : images)
      for (const char* region : {"box", "full"})
        text += std::string("ball_") + image + ".png," + region + ",0,0,0,0,0,0\n";
    const auto table = scratch.file("l.csv", text);
    return message_of<DataError>([&] { read_comparison({{"a", table}}, kOursAlone, cases()); });
  };
  EXPECT_EQ(said("b"), "row 'ours': ball_a was not measured");
  EXPECT_EQ(said("abc"), "3 images were measured, the benchmark has 2");
  EXPECT_THAT(faults_in<ComparisonConfig>("rows: [{name: ours, method: a}]", "c.yaml"),
              testing::ElementsAre("c.yaml:1:7: rows: needs at least two: the one judged and another"));
}

struct Score {
  double ssim_s, ssim_w, mae, psnr_db;
};

MethodScores method(const std::string& name, const Score& score) {
  MethodScores out{.row = {.name = name, .method = name, .group = ""}, .images = {"ball_a", "ball_b"}, .cells = {}};
  for (const auto& [column, value] :
       {std::pair{"ssim_s", score.ssim_s}, {"ssim_w", score.ssim_w}, {"mae", score.mae}, {"psnr_db", score.psnr_db}})
    for (const char* region : {"box", "full"}) out.cells[{region, column}] = {{value, 0.0}, {value, value}};
  return out;
}

TEST(Judgement, NeedsTheMustsAndEveryRivalBehindOnAllThree) {
  const Score good{.ssim_s = 0.85, .ssim_w = 0.8, .mae = 0.02, .psnr_db = 29.0},
      weak{.ssim_s = 0.7, .ssim_w = 0.9, .mae = 0.05, .psnr_db = 20.0};
  Score brighter = weak;
  brighter.psnr_db = 29.5;
  EXPECT_TRUE(judge({method("a", good), method("b", weak)}, cases()).musts);
  EXPECT_TRUE(judge({method("a", good), method("b", weak)}, cases()).ahead);
  EXPECT_FALSE(judge({method("a", good), method("b", weak), method("c", brighter)}, cases()).ahead);
  EXPECT_FALSE(judge({method("a", weak)}, cases()).musts);
  BenchmarkCases free = cases();
  free.must.reset();
  EXPECT_TRUE(judge({method("a", weak), method("b", weak)}, free).musts);
  EXPECT_THAT(to_markdown({method("a", good), method("b", weak)}, free),
              testing::HasSubstr("The first row there is ahead of every other row on SSIM-S, MAE and PSNR: yes.\n"));
  const std::string page = to_markdown({method("ours", good), method("rival", brighter)}, cases());
  EXPECT_THAT(page, testing::HasSubstr("| ours | 0.850 | 0.800 | 0.0200 | 29.00 | 0.850 | 0.800 | 0.0200 | 29.00 |\n"));
  EXPECT_THAT(page, testing::HasSubstr("(holds); ahead of every other row on the three: **no**."));
  EXPECT_THAT(page, testing::HasSubstr("| ball_b (fitted place) | 0.850"));
}

}  // namespace comparison_test
}  // namespace tacipc
