#include "stages/image/calibrate/sensor_parameters.h"

#include <gmock/gmock.h>

#include <cmath>

#include "common/base/error.h"
#include "common/sensor/camera_model.h"
#include "stages/image/calibrate/blocks.h"
#include "stages/image/calibrate/rest_membrane.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace sensor_parameters_test {

const std::string kConfigs = std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/";

TEST(SensorParameters, MoveWhatTheyName) {
  const SensorParameters ring(kConfigs + "mctac.yaml", {{.name = "ring_radius_mm", .sigma = 0.5},
                                                        {.name = "ring_z_mm", .sigma = 1.0},
                                                        {.name = "ring_azimuth_deg", .sigma = 3.0},
                                                        {.name = "camera_x_mm", .sigma = 0.2},
                                                        {.name = "camera_rotation_z_deg", .sigma = 1.0},
                                                        {.name = "window_scale", .sigma = 0.02},
                                                        {.name = "vignetting_v2", .sigma = 0.1},
                                                        {.name = "gamma", .sigma = 0.1, .mean = 2.1},
                                                        {.name = "specular_f0", .sigma = 0.01}});
  ASSERT_EQ(ring.count(), 9);
  EXPECT_EQ(ring.mean(0), 10.0);
  EXPECT_EQ(ring.mean(7), 2.1);
  EXPECT_EQ(ring.upper()[2], 4.0);
  EXPECT_EQ(ring.led_paths()[1], "leds.ring.lit[1]");
  Eigen::VectorXd u(9);
  u << 1, -1, 2, 0.5, 1, -1, -2, 1, -1;
  const Sensor moved = ring.sensor(u);
  EXPECT_NEAR(moved.leds[0].position_m.head<2>().norm(), 10.5e-3, 1e-12);
  EXPECT_NEAR(moved.leds[0].position_m.z(), -14e-3, 1e-12);
  EXPECT_NEAR(std::atan2(moved.leds[0].position_m.y(), moved.leds[0].position_m.x()), 51 * M_PI / 180, 1e-12);
  EXPECT_NEAR(moved.camera.position_m.x(), 0.1e-3, 1e-12);
  EXPECT_NEAR(moved.camera.position_m.z(), -12e-3, 1e-12);
  EXPECT_NEAR(moved.camera.rotation_rad.z(), M_PI / 180, 1e-12);
  EXPECT_NEAR(moved.camera.window_width_m, 0.98 * 15e-3, 1e-12);
  EXPECT_NEAR(moved.camera.vignetting[0], -0.2, 1e-12);
  EXPECT_EQ(moved.response.curve, "gamma");
  EXPECT_NEAR(moved.response.gamma, 2.2, 1e-12);
  EXPECT_NEAR(moved.coating.specular_f0, 0.03, 1e-12);
  EXPECT_EQ(ring.changes(Eigen::VectorXd::Zero(9)).size(), 10u);  // gamma changes the curve's name too
}

TEST(SensorParameters, MoveListsOfLedsAsAWhole) {
  const SensorParameters list(kConfigs + "gelsight_lab.yaml", {{.name = "list_x_mm", .sigma = 1.0},
                                                               {.name = "list_z_mm", .sigma = 1.0},
                                                               {.name = "list_scale", .sigma = 0.1},
                                                               {.name = "list_azimuth_deg", .sigma = 10.0},
                                                               {.name = "emission_exponent", .sigma = 5.0}});
  EXPECT_EQ(list.led_paths()[2], "leds.list[2]");
  EXPECT_EQ(list.lower()[1], -4.0);
  EXPECT_GT(list.upper()[1], 1.0);  // the gel begins 1.5 mm farther on
  EXPECT_LT(list.upper()[1], 1.5);
  Eigen::VectorXd u(5);
  u << 2, -0.5, 1, 9, 1;
  const Sensor moved = list.sensor(u);
  const SensorParameters upright(kConfigs + "mctac.yaml", {{.name = "ring_tilt_deg", .sigma = 3.0}});
  EXPECT_EQ(upright.lower()[0], 0.0);  // no tilt is below none
  const Led& led = list.nominal().leds[0];
  // A quarter turn takes (x, y) to (−y, x).
  EXPECT_NEAR(moved.leds[0].position_m.x(), 2e-3 - 1.1 * led.position_m.y(), 1e-12);
  EXPECT_NEAR(moved.leds[0].position_m.y(), 1.1 * led.position_m.x(), 1e-12);
  EXPECT_NEAR(moved.leds[0].position_m.z(), led.position_m.z() - 0.5e-3, 1e-12);
  EXPECT_NEAR(moved.leds[0].normal.x(), -led.normal.y(), 1e-12);
  EXPECT_NEAR(moved.leds[0].normal.z(), led.normal.z(), 1e-12);
  EXPECT_EQ(moved.leds[0].emission_exponent, 65.0);
}

TEST(SensorParameters, WindowsOfAnglesAndFocalLengthsScaleAlike) {
  const ScratchFolder scratch;
  std::string text = read_file(kConfigs + "digit.yaml");
  const std::size_t at = text.find("horizontal_fov_deg");
  ASSERT_NE(at, std::string::npos);
  const SensorParameters angle(kConfigs + "digit.yaml", {{.name = "window_scale", .sigma = 0.1}});
  const Eigen::VectorXd one = Eigen::VectorXd::Constant(1, 1.0);
  const double wide = (*angle.sensor(one).camera.intrinsics_px)[0];
  EXPECT_NEAR(wide, (*angle.nominal().camera.intrinsics_px)[0] / 1.1, 1e-9 * wide);
  const Camera& camera = angle.nominal().camera;
  text.erase(text.find("horizontal_fov_deg_src"),
             text.find('\n', text.find("horizontal_fov_deg_src")) - text.find("horizontal_fov_deg_src"));
  text.replace(at, text.find('\n', at) - at,
               fmt::format("intrinsics_px: [{0}, {0}, {1}, {2}]", (*camera.intrinsics_px)[0], 0.5 * camera.width_px,
                           0.5 * camera.height_px));
  const SensorParameters focal(scratch.file("focal.yaml", text), {{.name = "window_scale", .sigma = 0.1}});
  EXPECT_NEAR((*focal.sensor(one).camera.intrinsics_px)[1], wide, 1e-9 * wide);
}

TEST(SensorParameters, RefusesWhatTheSensorDoesNotHave) {
  const auto fault = [](const FreeParameter& parameter) {
    return message_of<UsageError>([&] { SensorParameters(kConfigs + "mctac.yaml", {parameter}); });
  };
  EXPECT_EQ(fault({.name = "list_scale", .sigma = 0.1}),
            "sensor_fit.parameters.list_scale: " + kConfigs +
                "mctac.yaml has none; it has ring_radius_mm, ring_z_mm, ring_azimuth_deg, ring_tilt_deg, camera_x_mm, "
                "camera_y_mm, camera_z_mm, camera_rotation_z_deg, window_scale, vignetting_v2, vignetting_v4, gamma, "
                "specular_f0, ggx_alpha");
  EXPECT_THAT(fault({.name = "ring_z_mm", .sigma = 4.0, .bounds = std::array{-20.0, 3.0}}),
              testing::StartsWith(
                  "sensor_fit.parameters.ring_z_mm: 3 makes no valid sensor; give other bounds\nthe fitted sensor:"));
  EXPECT_EQ(fault({.name = "gamma", .sigma = 0.1, .mean = 2.0, .bounds = std::array{2.1, 2.4}}),
            "sensor_fit.parameters.gamma: its mean, 2, is outside its bounds, 2.1 … 2.4");
}

TEST(SensorParameters, NeedLeds) {
  LightField light;
  light.geometry.environment_degree = 1;
  light.geometry.field_half_width_m = 7.5e-3;
  light.geometry.shadow_softness = 0.1;
  light.weights = Eigen::MatrixXd::Zero(light.geometry.num_features(), 3);
  const auto section = light.to_value().map().front();
  const ScratchFolder scratch;
  const auto path = scratch.file("lit.yaml", changed_sensor(kConfigs + "mctac.yaml",
                                                            {{"leds"},
                                                             {"coating"},
                                                             {"ambient"},
                                                             {"response"},
                                                             {"markers"},
                                                             {section.first, section.second},
                                                             {"reference_image", "r.png", "known"}},
                                                            "made by a test"));
  EXPECT_EQ(message_of<UsageError>([&] { SensorParameters(path, {}); }),
            path.string() + " has no leds, whose colours sensor_fit could fit");
}

TEST(SensorFitConfig, FaultsHaveTheirPlace) {
  EXPECT_THAT(faults_in<SensorFitConfig>("sensor_fit:\n  block_px: 8\n  sigma_codes: 0\n  parameters:\n"
                                         "    ring_radios_mm: {sigma: 1}\n    gamma: {sigma: 0.1, bounds: [3, 2]}\n",
                                         "c.yaml"),
              testing::ElementsAre("c.yaml:3:16: sensor_fit.sigma_codes: 0 is outside (0, inf)",
                                   "c.yaml:5:5: sensor_fit.parameters.ring_radios_mm: unknown key (did you mean "
                                   "ring_radius_mm?)",
                                   "c.yaml:6:33: sensor_fit.parameters.gamma.bounds: expected [least, largest]"));
}

TEST(RestMembrane, LiesOnTheFrontOfDiscAndDome) {
  const GelShape disc{.outline = GelShape::Outline::disc, .radius_m = 15e-3, .thickness_m = 2e-3};
  GelShape dome{.outline = GelShape::Outline::rectangle, .width_m = 20e-3, .height_m = 15e-3, .thickness_m = 4e-3};
  dome.dome_radius_m = 60e-3;
  for (const GelShape& shape : {disc, dome}) {
    const Membrane membrane = rest_membrane(shape);
    EXPECT_EQ(count_loops(membrane.outline), 1);
    double area = 0.0;
    for (Eigen::Index f = 0; f < membrane.triangles.rows(); ++f) {
      const Vector3 a = membrane.positions.row(membrane.triangles(f, 0)),
                    b = membrane.positions.row(membrane.triangles(f, 1)),
                    c = membrane.positions.row(membrane.triangles(f, 2));
      EXPECT_GT((b - a).cross(c - a).z(), 0.0);
      area += 0.5 * (b - a).cross(c - a).z();
    }
    EXPECT_NEAR(area, shape.dome_radius_m ? 300e-6 : M_PI * 225e-6, 1e-3 * area);
    for (Eigen::Index v = 0; v < membrane.positions.rows(); ++v) {
      const Vector3 at = membrane.positions.row(v);
      EXPECT_EQ(at.z(), shape.front_z(at.x(), at.y()));
      if (!shape.dome_radius_m || std::abs(at.x()) > 9e-3 || std::abs(at.y()) > 7e-3) continue;
      const Vector3 normal = (at + Vector3(0, 0, 60e-3)).normalized();
      EXPECT_LT((membrane.normals.row(v).transpose() - normal).norm(), 1e-4);
    }
  }
}

TEST(BlockCodes, AreMidmeansAndKnowClipping) {
  ByteImage image(4, 4, 1);
  const std::array<int, 4> block = {10, 13, 14, 200};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      image.at(x, y, 0) = static_cast<std::uint8_t>(x < 2 && y < 2 ? block[static_cast<std::size_t>(2 * y + x)] : 255);
  image.at(2, 0, 0) = image.at(3, 0, 0) = image.at(2, 1, 0) = 7;
  const FloatImage codes = block_codes(image, 2);
  EXPECT_EQ(codes.width, 2);
  EXPECT_EQ(codes.at(0, 0, 0), 13.5f);  // of 10 13 14 200 the middle two
  EXPECT_EQ(codes.at(1, 0, 0), 7.0f);   // one of four is clipped and falls out
  EXPECT_TRUE(std::isnan(codes.at(0, 1, 0)));
  EXPECT_EQ(block_codes(image, 1).at(1, 0, 0), 13.0f);
}

}  // namespace sensor_parameters_test
}  // namespace tacipc
