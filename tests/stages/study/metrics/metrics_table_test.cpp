#include "stages/study/metrics/metrics_table.h"

#include <gmock/gmock.h>

#include <cmath>

#include "stages/study/metrics/metrics_config.h"
#include "tests/config_text.h"

namespace tacipc {
namespace {

TEST(MetricsConfig, TheKindTellsTheFilesAndTheKeys) {
  const auto images = config_from_text<MetricsConfig>("{kind: images}", "m.yaml"),
             depth = config_from_text<MetricsConfig>("{kind: depth, pressed_mm: 0.02}", "m.yaml");
  EXPECT_EQ(images.ends_with, ".png");
  EXPECT_TRUE(std::holds_alternative<ImageMetrics>(images.what));
  EXPECT_EQ(depth.ends_with, ".exr");
  EXPECT_DOUBLE_EQ(std::get<DepthMetrics>(depth.what).pressed_m, 0.02e-3);
  EXPECT_THAT(faults_in<MetricsConfig>("{kind: depth, crop_px: [0, 0, 20, 20]}", "m.yaml"),
              testing::ElementsAre("m.yaml:1:1: pressed_mm: missing", "m.yaml:1:15: crop_px: unknown key"));
}

TEST(Csv, ShortestNumbersInfinityAndQuotes) {
  const MetricsRow row{
      .name = "a,\"b\".png", .region = "full", .values = {{"mae", 0.1}, {"psnr_db", INFINITY}, {"pixels", 307200.0}}};
  EXPECT_EQ(to_csv({row}), "name,region,mae,psnr_db,pixels\n\"a,\"\"b\"\".png\",full,0.1,inf,307200\n");
}

TEST(Summary, MeansDeviationsAndPooledPsnr) {
  const std::vector<MetricsRow> rows = {
      {.name = "1", .region = "full", .values = {{"mae", 0.1}, {"mse", 0.01}, {"psnr_db", 20.0}}},
      {.name = "2", .region = "full", .values = {{"mae", 0.3}, {"mse", 0.03}, {"psnr_db", 10.0}}}};
  const std::string text = to_yaml(summary_of(rows));
  EXPECT_THAT(text, testing::StartsWith("full:\n  images: 2\n  mae:\n    mean: 0.2\n    std: 0.0"));
  EXPECT_THAT(text, testing::HasSubstr("  psnr_db:\n    mean: 15\n    std: 5\n"));
  EXPECT_THAT(text, testing::HasSubstr("psnr_db_of_mean_mse: 16.98970004336"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("crop")));
}

}  // namespace
}  // namespace tacipc
