#include "stages/rival/baseline/change.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/statistics.h"
#include "stages/rival/baseline/kernel.h"
#include "tests/config_text.h"

namespace tacipc {
namespace change_test {

/// 40 × 30 pixels of 0.2 mm, the camera 49 mm away.
Sensor small_sensor() {
  Sensor sensor;
  sensor.camera = {.position_m = {0.0, 0.0, -49e-3},
                   .width_px = 40,
                   .height_px = 30,
                   .window_width_m = 8e-3,
                   .window_height_m = 6e-3};
  return sensor;
}

ChangeConfig shipped(const std::string& name) {
  return read_config<BaselineConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/rivals/baseline/" + name + ".yaml")
      .change.value();
}

/// A plane that rises into the gel by these slopes.
Raster plane(double slope_x, double slope_y) {
  Raster height(40, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) height.at(x, y) = 0.2e-3 * (slope_x * x + slope_y * y);
  return height;
}

bool is_zero(const FloatImage& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return v == 0.0F; });
}

TEST(Change, SlopesAreCentralAndTheBorderHasThoseOfItsNeighbour) {
  const Slopes slopes = slopes_of(plane(0.5, -0.25), 0.2e-3);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      EXPECT_NEAR(slopes.x.at(x, y), 0.5, 1e-12);
      EXPECT_NEAR(slopes.y.at(x, y), -0.25, 1e-12);
    }
  Raster bowl(40, 30);  // x² + y² pixels: slopes 2 x and 2 y inside
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) bowl.at(x, y) = x * x + y * y;
  const Slopes inside = slopes_of(bowl, 1.0);
  EXPECT_EQ(inside.x.at(5, 7), 10.0);
  EXPECT_EQ(inside.x.at(0, 7), 2.0);
  EXPECT_EQ(inside.y.at(0, 7), 14.0);
  EXPECT_EQ(inside.x.at(39, 29), 76.0);
  EXPECT_EQ(inside.y.at(39, 29), 56.0);
}

TEST(Change, OurLightIsThatOfShade) {
  const Sensor sensor = small_sensor();
  LightField light{.geometry = {.environment_degree = 1, .field_degree = 0, .field_half_width_m = 4e-3},
                   .weights = {},
                   .blur_px = 1.0};
  light.weights.resize(light.geometry.num_features(), 3);
  light.weights << 10, 20, 30, 40, 50, 60;
  ChangeConfig config;
  config.model = ChangeConfig::Model::light_field;
  const ChangeOfCodes change(config, light, sensor);
  EXPECT_TRUE(is_zero(change(Raster(40, 30), {})));
  const Raster slanted = plane(0.75, 0.0);
  EXPECT_EQ(change(slanted, {}).pixels, code_change(light, view_height_map(to_image(slanted), sensor)).pixels);
  EXPECT_FALSE(is_zero(change(slanted, {})));
}

// A flat gel under the published lights has codes (57, 96, 58); slopes turn the lights' shares.
TEST(Change, LightsOfChenAreAddedAndCutAndAFlatGelIsTheirZero) {
  ChangeConfig config = shipped("chen_2022");
  config.blur.reset();
  config.metres_per_pixel = 0.2e-3;
  const Sensor sensor = small_sensor();
  const ChangeOfCodes change(config, {}, sensor);
  EXPECT_TRUE(is_zero(change(Raster(40, 30), {})));
  // n = (0.6, 0, 0.8): depths fall to the right where heights rise. 0.6 max(N · L, 0) of the three lights: 0, 0.16512,
  // 0.47688: (0, 0, 0), then (3.6, 37.0, 0.8), then (3.3, 94.9, 121.6) more.
  const FloatImage slanted = change(plane(0.75, 0.0), {});
  EXPECT_EQ(slanted.at(20, 15, 0), 6 - 57);
  EXPECT_EQ(slanted.at(20, 15, 1), 130 - 96);
  EXPECT_EQ(slanted.at(20, 15, 2), 121 - 58);
}

TEST(Change, ATableIsLookedUpAtEveryPixel) {
  SlopeTable table(125);
  double* bin = table.at(table.inclination_bin(0.5), table.direction_bin(0.5, 0.0));
  bin[3 * 5 + 0] = 20.0;  // constant, red
  bin[3 * 3 + 2] = 8.0;   // along x, blue
  const ChangeOfCodes change(shipped("taxim"), table, small_sensor());
  const FloatImage codes = change(plane(0.5, 0.0), {});
  EXPECT_EQ(codes.at(10, 15, 0), 20.0F);
  EXPECT_FLOAT_EQ(codes.at(10, 15, 2), static_cast<float>(8.0 * (21.0 / 40.0 - 1.0)));
  EXPECT_TRUE(is_zero(change(plane(0.0, 0.5), {})));
}

TEST(Change, OfANetworkAFlatGelIsExactlyZero) {
  LightNetwork network;
  network.layers[0].weights(4, 2) = 2.0F;  // of n_x
  network.layers[0].weights(4, 0) = 1.0F;  // and x
  for (const std::size_t l : {1U, 2U}) network.layers[l].weights(4, 4) = 1.0F;
  network.layers[3].weights(1, 4) = 0.5F;
  const ChangeOfCodes change(shipped("fots"), network, small_sensor());
  EXPECT_TRUE(is_zero(change(Raster(40, 30), {})));
  // (1 + n_x)/2 goes from 0.5 to 0.2 at a slope of 3/4: 2 · 0.5 · −0.3 of 255 codes.
  const FloatImage codes = change(plane(0.75, 0.0), {});
  EXPECT_NEAR(codes.at(10, 15, 1), -0.3 * 255.0, 1e-3);
  EXPECT_EQ(codes.at(10, 15, 0), 0.0F);
}

TEST(Change, MetalLampsLightTheObjectAndLeaveTheFront) {
  const MetallicLamps lamps{.change_factor = 0.5,
                            .lamps = {{.position_m = {28e-3, 0.0, -11e-3}, .rgb = {1.0, 0.0, 0.0}}}};
  ChangeConfig config = shipped("tacto");
  config.window.reset();
  const Sensor sensor = small_sensor();
  const ChangeOfCodes change(config, lamps, sensor);
  std::vector<Vector3> normal(1200, Vector3::Zero());
  Raster height(40, 30);
  const std::size_t pixel = 15 * 40 + 30;
  normal[pixel] = Vector3(0.6, 0.0, -0.8);
  height.values[pixel] = 0.3e-3;
  const FloatImage codes = change(height, normal);
  // The pixel's ray meets z = −0.3 mm this much nearer to the axis than z = 0.
  const Vector3 rest(2.1e-3, 0.1e-3, 0.0), point = rest + Vector3(-2.1, -0.1, -49.0) * (0.3 / 49.0) * 1e-3;
  const Vector3& eye = sensor.camera.position_m;
  const double expected = 0.5 * (metallic_code(metallic_light(point, normal[pixel], eye, lamps.lamps[0].position_m)) -
                                 metallic_code(metallic_light(rest, {0, 0, -1}, eye, lamps.lamps[0].position_m)));
  EXPECT_GT(expected, 10.0);
  EXPECT_NEAR(codes.at(30, 15, 0), expected, 1e-4);
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 30; ++y) EXPECT_EQ(codes.at(x, y, 0) != 0.0F, x == 30 && y == 15) << x << ", " << y;
  // Without an object's normals the map's slopes count.
  EXPECT_NE(change(height, {}).at(31, 15, 0), 0.0F);
}

TEST(Change, TheWindowKeepsTheSumAndItsLength) {
  const MetallicLamps lamps{.change_factor = 1.0,
                            .lamps = {{.position_m = {28e-3, 0.0, -11e-3}, .rgb = {1.0, 1.0, 1.0}}}};
  ChangeConfig config = shipped("tacto");  // OpenCV's seven weights, σ 1.369 of 0.16667 mm: 1.141 pixels of 0.2 mm, ±3
  std::vector<Vector3> normal(1200, Vector3::Zero());
  normal[15 * 40 + 20] = Vector3(0.6, 0.0, -0.8);
  Raster height(40, 30);
  height.at(20, 15) = 0.1e-3;
  const FloatImage blurred = ChangeOfCodes(config, lamps, small_sensor())(height, normal);
  config.window.reset();
  const FloatImage sharp = ChangeOfCodes(config, lamps, small_sensor())(height, normal);
  double sum = 0.0, second = 0.0;
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 30; ++y) {
      const double code = double{blurred.at(x, y, 1)};
      sum += code;
      second += code * (x - 20) * (x - 20);
    }
  EXPECT_NEAR(sum, double{sharp.at(20, 15, 1)}, 1e-3);
  EXPECT_NEAR(std::sqrt(second / sum), 1.141, 0.06);  // less what the cut takes
}

TEST(Noise, HasItsDeviationAndDependsOnTheSeedAlone) {
  ByteImage a(200, 100, 3, 128), b = a, c = a;
  add_noise(a, 7.0, 1);
  add_noise(b, 7.0, 1);
  add_noise(c, 7.0, 2);
  EXPECT_EQ(a.pixels, b.pixels);
  EXPECT_NE(a.pixels, c.pixels);
  const auto statistics = mean_and_deviation(std::vector<double>(a.pixels.begin(), a.pixels.end()));
  EXPECT_NEAR(statistics.mean, 127.5, 0.2);  // cut to whole codes
  EXPECT_NEAR(statistics.deviation, 7.0, 0.1);
}

TEST(ForceDepth, IsLinearUpToTheLargestForceAndGoesToTheCamera) {
  // As TACTO's settings for DIGIT have it: 0 to 100 N over 5 mm.
  const auto depth = [](double newtons) {
    return ForceDepth{.applied_n = newtons, .largest_n = 100.0, .deepest_m = 5e-3}.depth_m();
  };
  EXPECT_EQ(depth(0.0), 0.0);
  EXPECT_NEAR(depth(20.0), 1e-3, 1e-18);
  EXPECT_NEAR(depth(250.0), 5e-3, 1e-18);
  const ForceDepth force{.applied_n = 20.0, .largest_n = 100.0, .deepest_m = 5e-3};
  const Vector3 way = force.way_m({3e-3, 0.0, 1e-3}, {0.0, 0.0, -3e-3});
  EXPECT_NEAR((way - 1e-3 * Vector3(-0.6, 0.0, -0.8)).norm(), 0.0, 1e-15);
}

TEST(BaselineConfig, FaultsOfTheNewMethodsAreSaid) {
  EXPECT_THAT(faults_in<BaselineConfig>("deformation: {method: pyramid, designed_mm_per_px: 0, contact_share: 2, "
                                        "levels: [{size_px: 4}]}\ntexture_sigma_mm: 0\n",
                                        "b.yaml"),
              testing::ElementsAre(testing::HasSubstr("designed_mm_per_px"), testing::HasSubstr("contact_share"),
                                   testing::HasSubstr("size_px: expected an odd number")));
}

}  // namespace change_test
}  // namespace tacipc
