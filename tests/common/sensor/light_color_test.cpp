// Colours of light sources against colour tables.
#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "common/sensor/light_color.h"

namespace tacipc {
namespace light_color_test {

TEST(ColorOfTemperature, MatchesTheTable) {
  const std::vector<std::pair<double, std::array<double, 3>>> table = {
      {2700, {1, .423, .100}}, {3000, {1, .484, .155}}, {3500, {1, .577, .261}},
      {4000, {1, .659, .379}}, {5000, {1, .795, .630}}, {5500, {1, .851, .755}},
      {6500, {1, .944, .992}}, {7500, {.829, .842, 1}}, {10000, {.611, .695, 1}}};
  for (const auto& [kelvin, expected] : table) {
    const auto color = color_of_temperature(kelvin);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(color[c], expected[c], 5e-3) << kelvin << " K, channel " << c;
  }
}

TEST(ColorOfLine, MatchesTheTable) {
  const std::vector<std::tuple<double, double, std::array<double, 3>>> table = {
      {625, 18, {6.02, -.38, -.07}}, {525, 33, {-.97, 1.69, -.07}}, {467, 22, {-1.30, .07, 17.02}}};
  for (const auto& [peak, width, expected] : table) {
    const auto color = color_of_line(peak, width);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(color[c], expected[c], 1e-2 + 5e-3 * std::abs(expected[c])) << peak << " nm, channel " << c;
  }
}

}  // namespace light_color_test
}  // namespace tacipc
