#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.h"
#include "stages/comparison/method_table.h"
#include "stages/comparison/sheet.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace {

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

TEST(Scores, AreReadByImageAndRegionWhateverTheOrder) {
  const ScratchFolder scratch;
  const auto file = scratch.file(
      "s.csv", kHeader +
                   "ball/ball_b.png,full,0.1,0,20,0,0.5,0.6\nball/ball_b.png,box,0.2,0,10,0,0.4,0.5\n"
                   "ball/ball_a.png,full,0.01,0,30,0,0.9,0.95\nball/ball_a.png,box,0.02,0,25,0,0.8,0.85\n");
  const MethodScores scores = read_scores(file, "ours", cases());
  ASSERT_EQ(scores.box.size(), 2u);
  EXPECT_EQ(scores.box[0].mae, 0.02);
  EXPECT_EQ(scores.box[1].ssim_s, 0.5);
  EXPECT_EQ(scores.full[1].ssim_w, 0.5);
  EXPECT_NEAR(mean_of(scores.box).psnr_db, 17.5, 1e-12);
  const auto lacking = scratch.file("l.csv", kHeader + "ball_a.png,box,0,0,0,0,0,0\n");
  EXPECT_EQ(message_of<DataError>([&] { read_scores(lacking, "ours", cases()); }),
            lacking.string() + ": has no row for ball_a (full)");
  const auto other = scratch.file("o.csv", "name,region,mae\n");
  EXPECT_EQ(message_of<DataError>([&] { read_scores(other, "ours", cases()); }),
            other.string() + ": has no column ssim_s");
}

MethodScores method(const std::string& name, const Score& score) {
  return {.name = name, .box = {score, score}, .full = {score, score}};
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

TEST(Sheet, ShowsPhotographOursDifferenceAndRival) {
  const SheetRow row{.real = ByteImage(100, 80, 3, 100),
                     .ours = ByteImage(100, 80, 3, 90),
                     .rival = ByteImage(100, 80, 3, 40),
                     .box_px = {30, 30, 20, 10}};
  SheetRow corner = row;
  corner.box_px = {90, 0, 10, 10};
  const ByteImage out = sheet({row, corner});
  EXPECT_EQ(out.width, 4 + 4 * 64);    // 20 + 2 · 20 wide, 4 between
  EXPECT_EQ(out.height, 4 + 54 + 34);  // 10 + 2 · 20, then 10 + 20 high
  EXPECT_EQ(out.at(0, 0, 0), 255);
  EXPECT_EQ(out.at(10, 10, 1), 100);
  EXPECT_EQ(out.at(74, 10, 1), 90);
  EXPECT_EQ(out.at(138, 10, 1), 108);  // 128 + 2 (90 − 100)
  EXPECT_EQ(out.at(202, 10, 1), 40);
  EXPECT_EQ(out.at(5, 60, 1), 100);
  EXPECT_EQ(out.at(35, 60, 1), 255);  // the second row is only 30 wide
}

}  // namespace
}  // namespace tacipc
