#include "stages/rival/baseline/phong.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/config/config.h"

namespace tacipc {
namespace phong_test {

BaselineConfig shipped(const std::string& name) {
  return read_config<BaselineConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/rivals/baseline/" + name + ".yaml");
}

/// Codes in the middle of a plane z' = slope_x x + slope_y y (in pixels) before a grey photograph, without final blur.
std::array<int, 3> bgr_on_slope(double slope_x, double slope_y) {
  PhongConfig config = *shipped("gomes_2021").phong;
  config.final_blur.reset();
  Raster depth(7, 7);
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 7; ++x) depth.at(x, y) = config.metres_per_pixel * (slope_x * x + slope_y * y);
  const ByteImage image = phong_image(ByteImage(7, 7, 3, 128), depth, Raster(7, 7), config);
  return {image.at(3, 3, 2), image.at(3, 3, 1), image.at(3, 3, 0)};  // B G R
}

// Pixel values of the published simulator.
TEST(Phong, FlatAndSlopesHaveThePublishedCodes) {
  EXPECT_THAT(bgr_on_slope(0.0, 0.0), testing::ElementsAre(135, 121, 142));
  EXPECT_THAT(bgr_on_slope(0.2, 0.0), testing::ElementsAre(147, 118, 140));
  EXPECT_THAT(bgr_on_slope(-0.2, 0.0), testing::ElementsAre(123, 124, 142));
  EXPECT_THAT(bgr_on_slope(0.0, 0.2), testing::ElementsAre(119, 103, 151));
  EXPECT_THAT(bgr_on_slope(0.0, -0.2), testing::ElementsAre(159, 146, 147));
}

TEST(Phong, FlatOpacitiesOfBothLightSets) {
  const auto opacities = [](const char* name) {
    std::vector<double> out;
    const PhongConfig config = *shipped(name).phong;
    for (const PhongLight& light : config.lights) out.push_back(phong_opacity(light, {0, 0, 1}, 5));
    return out;
  };
  // d k_d + (2 d − L_z)⁵ k_s with d = L_z = 1/4: 1/4 k_d + k_s / 1024.
  EXPECT_THAT(opacities("gomes_2021"), testing::ElementsAre(testing::DoubleNear(0.15 + 0.5 / 1024, 1e-15),
                                                            testing::DoubleNear(0.125 + 0.3 / 1024, 1e-15),
                                                            testing::DoubleNear(0.15 + 0.4 / 1024, 1e-15),
                                                            testing::DoubleNear(0.025 + 0.1 / 1024, 1e-15)));
  EXPECT_THAT(opacities("gomes_2017"), testing::ElementsAre(testing::DoubleNear(0.15 + 0.4 / 1024, 1e-15),
                                                            testing::DoubleNear(0.025 + 0.4 / 1024, 1e-15),
                                                            testing::DoubleNear(0.025 + 0.4 / 1024, 1e-15)));
}

// Each light of gomes_2017 comes from its own side: opacities of planes that face −x and −y, by hand.
TEST(Phong, LightsOf2017ComeFromTheirSides) {
  const PhongConfig config = *shipped("gomes_2017").phong;
  const auto opacity = [&](std::size_t light, double nx, double ny) {
    return phong_opacity(config.lights[light], {nx, ny, 0.8}, 5);
  };
  // Red, L = (−1, 0, 1/4): d = N · L = 0.8 of (−0.6, 0, 0.8) and 0.2 of (0, −0.6, 0.8).
  EXPECT_NEAR(opacity(0, -0.6, 0.0), 0.6 * 0.8 + 0.4 * std::pow(1.03, 5), 1e-12);
  EXPECT_NEAR(opacity(0, 0.0, -0.6), 0.6 * 0.2 + 0.4 * std::pow(0.07, 5), 1e-12);
  // Green, L = (1/2, −0.866, 1/4): d = −0.1 and 0.7196; blue is its mirror image.
  EXPECT_NEAR(opacity(1, -0.6, 0.0), 0.4 * std::pow(-0.41, 5), 1e-12);
  EXPECT_NEAR(opacity(1, 0.0, -0.6), 0.1 * 0.7196 + 0.4 * std::pow(0.90136, 5), 1e-12);
  EXPECT_NEAR(opacity(2, 0.0, 0.6), opacity(1, 0.0, -0.6), 1e-15);
}

TEST(Phong, CodesAreTruncatedAndClampedEveryTime) {
  EXPECT_EQ(overlaid(102.4, 0.0, 0.0), 102);
  EXPECT_EQ(overlaid(100.0, 0.5, 101.0), 100);  // 100.5
  EXPECT_EQ(overlaid(10.0, -1.0, 200.0), 0);    // −180
  EXPECT_EQ(overlaid(10.0, 1.5, 250.0), 255);   // 370
}

TEST(Phong, ProtrusionDarkensAndTheBorderIsFlat) {
  PhongConfig config = *shipped("gomes_2021").phong;
  config.final_blur.reset();
  config.lights.clear();
  Raster protrusion(5, 5);
  protrusion.at(2, 2) = 0.25 * config.gel_thickness_m;
  protrusion.at(3, 3) = 9.0;
  Raster steep(5, 5);
  for (int x = 0; x < 5; ++x) steep.at(x, 0) = 1e-3 * x;
  const ByteImage image = phong_image(ByteImage(5, 5, 3, 200), steep, protrusion, config);
  EXPECT_EQ(image.at(0, 0, 0), 160);
  EXPECT_EQ(image.at(2, 2, 1), 120);  // 160 × 3/4
  EXPECT_EQ(image.at(3, 3, 2), 0);
  // A ramp along x lit from the left alone: the first and last column count as flat.
  config.lights = {{.direction = {-1, 0, 0.25}, .rgb = {255, 255, 255}, .diffuse = 1.0, .specular = 0.0}};
  Raster ramp(5, 5);
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) ramp.at(x, y) = 0.3 * config.metres_per_pixel * x;
  const ByteImage lit = phong_image(ByteImage(5, 5, 3, 200), ramp, Raster(5, 5), config);
  EXPECT_EQ(lit.at(0, 2, 0), lit.at(4, 2, 0));
  EXPECT_GT(lit.at(2, 2, 0), lit.at(0, 2, 0));
}

TEST(Phong, TheFinalBlurLeavesAConstantImage) {
  const PhongConfig config = *shipped("gomes_2021").phong;
  const ByteImage image = phong_image(ByteImage(20, 10, 3, 128), Raster(20, 10), Raster(20, 10), config);
  for (int x = 0; x < 20; ++x) {
    EXPECT_EQ(image.at(x, 4, 2), 135);
    EXPECT_EQ(image.at(x, 4, 1), 121);
    EXPECT_EQ(image.at(x, 4, 0), 142);
  }
}

}  // namespace phong_test
}  // namespace tacipc
