// Limits of forces over meshes.
#include "bench/element_study.h"

#include <gmock/gmock.h>

#include <cmath>

namespace tacipc::bench {
namespace element_study_test {

using ::testing::HasSubstr;

TEST(Extrapolate, FindsLimitAndOrder) {
  const std::vector<int> vertices{12000, 25000, 50000};
  for (const double order : {0.5, 1.0, 2.0, 3.5}) {
    std::vector<double> forces;
    for (const int n : vertices) forces.push_back(0.6 + 7.0 * std::pow(n, -order / 3.0));
    const auto limit = extrapolate(vertices, forces);
    ASSERT_TRUE(limit);
    EXPECT_NEAR(limit->value, 0.6, 1e-9);
    EXPECT_NEAR(limit->order, order, 1e-7);
  }
}

TEST(Extrapolate, SaysWhereThereIsNoLimit) {
  EXPECT_FALSE(extrapolate({1000, 2000, 4000}, {0.7, 0.6, 0.65}));
  EXPECT_FALSE(extrapolate({1000, 2000, 4000}, {0.7, 0.6, 0.4}));
}

TEST(ElementSection, ComparesBothElementsOnTheMeshesThatBothHave) {
  std::vector<bench::Run> runs;
  const auto add = [&](int n, const char* route, double force) {
    bench::Run& run = runs.emplace_back();
    run.name = {std::to_string(n), "sphere", "press", route, ""};
    run.gel_vertices = n;
    run.press_force_n = force;
    run.processor_s = 1e-3 * n;
  };
  EXPECT_EQ(element_section(runs), "");
  for (const int n : {1000, 8000, 64000}) {
    add(n, "averaged", 0.5 + 1.0 * std::pow(n, -1.0 / 3.0));
    add(n, "fast", 0.5 + 2.0 * std::pow(n, -1.0 / 3.0));
  }
  const std::string section = element_section(runs);
  EXPECT_THAT(section, HasSubstr("0.5000 N (order 1.0"));
  EXPECT_THAT(section, HasSubstr("| 8000 | 0.6000 | +20.0 % | 8.0 | 0.5500 | +10.0 % | 8.0 |"));
  EXPECT_THAT(element_svg(runs), HasSubstr("averaged volume"));
}

}  // namespace element_study_test
}  // namespace tacipc::bench
