#include "common/base/statistics.h"

#include <gtest/gtest.h>

namespace tacipc {
namespace statistics_test {

TEST(Statistics, MeanAndDeviationOverAll) {
  const auto of = mean_and_deviation({1.0, 2.0, 3.0, 6.0});
  EXPECT_EQ(of.mean, 3.0);
  EXPECT_DOUBLE_EQ(of.deviation, std::sqrt(3.5));
  EXPECT_EQ(mean_and_deviation({1.0, INFINITY}).mean, INFINITY);
  EXPECT_TRUE(std::isnan(mean_and_deviation({1.0, INFINITY}).deviation));
}

TEST(Statistics, MediansOfAnEvenNumberAreTheMeanOrTheLarger) {
  EXPECT_EQ(median(std::vector{9.0, 1.0, 5.0, 2.0}), 3.5);
  EXPECT_EQ(median(std::vector{4, 1, 2, 3}), 2.5) << "whole numbers too";
  EXPECT_EQ(upper_median(std::vector{9.0, 1.0, 5.0, 2.0}), 5.0);
  EXPECT_EQ(upper_median(std::vector{2.0f, 1.0f}), 2.0f);
}

TEST(Statistics, MediansOfAnOddNumberAreTheMiddle) {
  EXPECT_EQ(median(std::vector{9.0, 1.0, 5.0}), 5.0);
  EXPECT_EQ(upper_median(std::vector{9.0, 1.0, 5.0}), 5.0);
  EXPECT_EQ(upper_median(std::vector{7.0}), 7.0);
}

TEST(Statistics, QuantilesLieBetweenValuesInProportion) {
  const std::vector<double> values{1, 2, 4, 8, 16};
  EXPECT_EQ(quantile(values, 0.0), 1);
  EXPECT_EQ(quantile(values, 0.25), 2);
  EXPECT_EQ(quantile(values, 0.5), 4);
  EXPECT_EQ(quantile(values, 0.625), 6) << "at 2.5: halfway from 4 to 8";
  EXPECT_EQ(quantile(values, 1.0), 16);
  EXPECT_EQ(quantile({7}, 0.95), 7);
}

TEST(Statistics, LowerQuantilesAreOneOfTheValues) {
  const std::vector<double> values{8, 1, 16, 2, 4};
  EXPECT_EQ(lower_quantile(values, 0.0), 1);
  EXPECT_EQ(lower_quantile(values, 0.24), 1);
  EXPECT_EQ(lower_quantile(values, 0.625), 4);
  EXPECT_EQ(lower_quantile(values, 1.0), 16);
}

}  // namespace statistics_test
}  // namespace tacipc
