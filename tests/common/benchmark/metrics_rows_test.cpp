#include "common/benchmark/metrics_rows.h"

#include <gmock/gmock.h>

#include <cmath>

namespace tacipc {
namespace metrics_rows_test {

TEST(MetricsRows, ShortestNumbersInfinityAndQuotes) {
  const MetricsRow row{
      .name = "a,\"b\".png", .region = "full", .values = {{"mae", 0.1}, {"psnr_db", INFINITY}, {"pixels", 307200.0}}};
  EXPECT_EQ(to_csv({row}), "name,region,mae,psnr_db,pixels\n\"a,\"\"b\"\".png\",full,0.1,inf,307200\n");
}

TEST(MetricsRows, MeansDeviationsAndPooledPsnr) {
  const std::vector<MetricsRow> rows = {
      {.name = "1", .region = "full", .values = {{"mae", 0.1}, {"mse", 0.01}, {"psnr_db", 20.0}}},
      {.name = "2", .region = "full", .values = {{"mae", 0.3}, {"mse", 0.03}, {"psnr_db", 10.0}}}};
  const std::string text = to_yaml(summary_of(rows));
  EXPECT_THAT(text, testing::StartsWith("full:\n  images: 2\n  mae:\n    mean: 0.2\n    std: 0.0"));
  EXPECT_THAT(text, testing::HasSubstr("  psnr_db:\n    mean: 15\n    std: 5\n"));
  EXPECT_THAT(text, testing::HasSubstr("psnr_db_of_mean_mse: 16.98970004336"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("crop")));
}

}  // namespace metrics_rows_test
}  // namespace tacipc
