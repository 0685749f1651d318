#include "common/rival/metallic_lamps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/config_text.h"

namespace tacipc {
namespace metallic_lamps_test {

/// Codes under the three pure lamps of TACTO's DIGIT, its camera looking along +x.
std::array<double, 3> digit_codes(const Vector3& point, const Vector3& normal) {
  const Vector3 camera(0.0, 0.0, 0.015);
  std::array<double, 3> codes{};
  for (std::size_t lamp = 0; lamp < 3; ++lamp) {
    const double angle = (30.0 + 120.0 * static_cast<double>(lamp)) * std::numbers::pi / 180.0;
    const Vector3 place(0.005, 0.02 * std::cos(angle), 0.015 + 0.02 * std::sin(angle));
    codes[lamp] = metallic_code(metallic_light(point, normal.normalized(), camera, place));
  }
  return codes;
}

// Codes of the released simulator's renderer, before rounding.
TEST(MetallicLamps, ThePublishedDigitHasItsCodes) {
  for (const double code : digit_codes({0.022, 0.0, 0.015}, {-1.0, 0.0, 0.0})) EXPECT_NEAR(code, 147.183, 5e-4);
  const auto aside = digit_codes({0.022, 0.005, 0.020}, {-1.0, 0.0, 0.0});
  EXPECT_NEAR(aside[0], 196.943, 5e-4);
  EXPECT_NEAR(aside[1], 129.741, 5e-4);
  EXPECT_NEAR(aside[2], 116.962, 5e-4);
  const auto slanted = digit_codes({0.022, 0.0, 0.015}, {-1.0, 0.5, 0.0});
  EXPECT_NEAR(slanted[0], 171.997, 5e-4);
  EXPECT_NEAR(slanted[1], 98.613, 5e-4);
  EXPECT_NEAR(slanted[2], 137.568, 5e-4);
}

TEST(MetallicLamps, CodesEndAtWhite) {
  EXPECT_EQ(metallic_code(3.0), 255.0);
  EXPECT_EQ(metallic_code(-1.0), 0.0);
  EXPECT_NEAR(metallic_code(std::pow(0.5, 2.2)), 127.5, 1e-12);
}

TEST(MetallicLamps, TheFileComesBack) {
  const MetallicLamps lamps{.change_factor = 0.5,
                            .lamps = {{.position_m = {1e-3, -2e-3, -11e-3}, .rgb = {1.0, 0.0, 0.25}}}};
  const auto read = config_from_text<MetallicLamps>(to_yaml(lamps.to_value()), "lamps.yaml");
  ASSERT_EQ(read.lamps.size(), 1U);
  EXPECT_NEAR((read.lamps[0].position_m - lamps.lamps[0].position_m).norm(), 0.0, 1e-15);
  EXPECT_EQ(read.lamps[0].rgb, lamps.lamps[0].rgb);
  EXPECT_EQ(read.change_factor, 0.5);
}

}  // namespace metallic_lamps_test
}  // namespace tacipc
