// The table of the shipped settings: depth errors, ratios, and what a run must be named.
#include "bench/defaults_report.h"

#include <gmock/gmock.h>

namespace tacipc::bench {
namespace defaults_report_test {

using ::testing::HasSubstr;

TEST(Defaults, DepthErrorIsThatOfPressedFrontVertices) {
  Positions near = Positions::Zero(5, 3), x = near, normal = Positions::Zero(3, 3);
  x.col(2) << 9.0, 2.0, -4.0, 7.0, 9.0;
  x.col(0).setConstant(5.0);  // sideways is no depth
  normal(0, 2) = -1e-9;
  normal(1, 1) = 0.5;
  EXPECT_DOUBLE_EQ(depth_error_m(x, near, {1, 2, 3}, normal), 3.0);  // of 2 and −4, not of 7
  EXPECT_EQ(depth_error_m(x, near, {1, 2, 3}, Positions::Zero(3, 3)), 0.0);
}

Run run(double cpu_s) {
  Run out;
  out.gel_vertices = 100;
  out.processor_s = cpu_s;
  out.parts = {{"linear_systems", 10 * cpu_s}, {"products", 100 * cpu_s}};
  return out;
}

TEST(Defaults, RatiosOfMeansStandBelowTheRows) {
  DefaultsRow star{"star", run(6.0), run(4.0), run(9.0), run(5.0), run(30.0), 4e-6, 30e-6};
  DefaultsRow gear{"gear", run(10.0), run(10.0), run(11.0), run(11.0), std::nullopt, std::nullopt, std::nullopt};
  const std::string table = defaults_table({star, gear}, "a machine");
  EXPECT_THAT(table, HasSubstr("a gel of 100 vertices"));
  EXPECT_THAT(table, HasSubstr("| star | 6.0 | 60 | 600 | 4.0 | 1.50 | 9.0 | 5.0 | 1.20 | 4.0 | 30.0 | 30.0 |\n"));
  EXPECT_THAT(table, HasSubstr("| gear | 10.0 | 100 | 1000 | 10.0 | 1.00 | 11.0 | 11.0 | 0.91 |  |  |  |\n"));
  EXPECT_THAT(table, HasSubstr("| **mean** | 8.0 | 80 | 800 | 7.0 | 1.14 | 10.0 | 8.0 | 1.00 | 4.0 | 30.0 | 30.0 |\n"));
}

}  // namespace defaults_report_test
}  // namespace tacipc::bench
