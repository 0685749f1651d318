#include "stages/gel/tetmesh/sizing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"
#include "tests/stages/gel/tetmesh/gels.h"

namespace tacipc {
namespace sizing_test {

constexpr double kMillimetre = 1e-3;

TEST(Sizing, PaperPresetHasThePapersLengths) {
  const Sizing sizing = sizing_for(preset("adaptive_0100um").sizing, mctac_gel());
  const auto front = [&](double r_mm) { return target_edge_length(sizing, {r_mm * kMillimetre, 0, 0}) / kMillimetre; };
  EXPECT_DOUBLE_EQ(front(0.0), 0.1);
  EXPECT_DOUBLE_EQ(front(2.5), 0.1);
  EXPECT_NEAR(front((2.5 + 6.6) / 2), 0.125, 1e-12);
  EXPECT_NEAR(front(6.6), 0.15, 1e-12);
  EXPECT_NEAR(front((6.6 + 15.0) / 2), (0.15 + 4.0) / 2, 1e-12);
  EXPECT_NEAR(front(15.0), 4.0, 1e-12);
  for (const double r : {0.0, 5.0, 14.9})
    EXPECT_NEAR(target_edge_length(sizing, {0, r * kMillimetre, -0.002}), 1e-3, 1e-15) << r;
}

TEST(Sizing, DepthBlendsWithItsExponent) {
  SizingConfig config = preset("adaptive_0100um").sizing;
  config.depth_exponent = 2.0;
  const Sizing sizing = sizing_for(config, mctac_gel());
  EXPECT_NEAR(target_edge_length(sizing, {0, 0, -0.001}), 1e-3 * (0.75 * 0.1 + 0.25 * 1.0), 1e-15);
  // Outside the gel the nearest depth counts.
  EXPECT_DOUBLE_EQ(target_edge_length(sizing, {0, 0, 0.5}), 1e-4);
  EXPECT_DOUBLE_EQ(target_edge_length(sizing, {0, 0, -0.5}), 1e-3);
}

TEST(Sizing, RectangleReachesItsRimLengthAtTheCorners) {
  const Sizing sizing = sizing_for(preset("adaptive_0250um").sizing, rectangle_gel(0.024, 0.018, 0.004));
  EXPECT_DOUBLE_EQ(sizing.reach_m(), 0.015);
  EXPECT_NEAR(target_edge_length(sizing, {0.012, 0.009, 0}), 4e-3, 1e-15);
}

TEST(Sizing, EstimateOfAUniformGelIsTheDensityTimesItsVolume) {
  SizingConfig config;
  config.centre_m = config.inner_m = config.rim_m = config.back_m = 2.5e-4;
  const double area = 0.02 * 0.016, h = 2.5e-4;
  const double by_hand = area * (4 / (std::sqrt(3.0) * h * h) + (0.004 - h) * std::sqrt(2.0) / (h * h * h));
  EXPECT_NEAR(estimated_vertices({config, rectangle_gel(0.02, 0.016, 0.004)}), by_hand, 0.01 * by_hand);
}

TEST(Sizing, EstimateOfARibbonIsThatOfItsArea) {
  // Edges as long as the ribbon is thick: vertices on both faces alone. 10⁶ × 24 mm, and the same upright.
  SizingConfig uniform;
  uniform.centre_m = uniform.inner_m = uniform.rim_m = uniform.back_m = 0.005;
  const double by_hand = 1000.0 * 0.024 * 4 / (std::sqrt(3.0) * 0.005 * 0.005);
  EXPECT_NEAR(estimated_vertices({uniform, rectangle_gel(1000.0, 0.024, 0.005)}), by_hand, 0.02 * by_hand);
  EXPECT_NEAR(estimated_vertices({uniform, rectangle_gel(0.024, 1000.0, 0.005)}), by_hand, 0.02 * by_hand);
  // Edges that grow from 2 mm at 6 mm to 1 m at the end 5 m away: fine near the centre only. The sum of 10 µm wide
  // strips.
  SizingConfig graded;
  graded.centre_m = graded.inner_m = 0.002;
  graded.centre_radius_m = 0.001;
  graded.inner_radius_m = 0.006;
  graded.rim_m = graded.back_m = 1.0;
  graded.depth_exponent = 0.25;
  const Sizing sizing{graded, rectangle_gel(10.0, 0.012, 1e-4)};
  double front = 0.0;
  for (double x = 5e-6; x < 5.0; x += 1e-5) {
    const double h = sizing.front(x);
    front += 2 * 1e-5 * 0.012 * 2 / (std::sqrt(3.0) * h * h);
  }
  EXPECT_NEAR(estimated_vertices(sizing), front, 0.05 * front);
}

TEST(Sizing, InnerRadiusMustLieInsideTheGel) {
  EXPECT_EQ(message_of<DataError>([] { sizing_for(preset("adaptive_0250um").sizing, disc_gel(0.005, 0.002)); }),
            "inner_radius_mm 6.6 does not lie inside the gel, which reaches 5 mm from its centre");
}

TEST(Sizing, ARectanglesDomeMustNotBeTooSteep) {
  GelShape gel = rectangle_gel(0.024, 0.018, 0.012);
  gel.dome_radius_m = 0.0213;
  EXPECT_NO_THROW(sizing_for(preset("tiny").sizing, gel));
  gel.dome_radius_m = 0.021;
  EXPECT_EQ(message_of<DataError>([&] { sizing_for(preset("tiny").sizing, gel); }),
            "the dome of radius 21 mm is steeper than 45 degrees at the corners, 15 mm from the centre");
}

TEST(Sizing, ADomeMustLeaveARim) {
  GelShape gel = disc_gel(0.012, 0.008);
  gel.dome_radius_m = 0.01301;  // sag 13.01 − √(13.01² − 12²) = 7.984 mm
  EXPECT_EQ(message_of<DataError>([&] { sizing_for(preset("tiny").sizing, gel); }),
            "the dome leaves 0.0159 mm of gel at the rim, less than 1 % of its thickness");
}

TEST(Sizing, FaultsNameTheirPlace) {
  EXPECT_EQ(message_of<ConfigError>([] {
              config_from_text<SizingConfig>(
                  "centre_mm: 0.1\ncentre_radius_mm: 7\ninner_mm: 0\ninner_radius_mm: 6\nrim_mm: 4\nrim_exponent: 1\n"
                  "back_mm: 1\ndepth_exponents: 1\n",
                  "s.yaml");
            }),
            "s.yaml:1:1: depth_exponent: missing\n"
            "s.yaml:2:19: centre_radius_mm: must be less than inner_radius_mm\n"
            "s.yaml:3:11: inner_mm: 0 is outside (0, inf)\n"
            "s.yaml:8:1: depth_exponents: unknown key (did you mean depth_exponent?)");
}

}  // namespace sizing_test
}  // namespace tacipc
