// Light between camera, lights and membrane: closed forms against tables, Snell's and Fresnel's laws, counted photons.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/camera_model.h"
#include "common/layered_path.h"
#include "common/light_color.h"
#include "common/sensor.h"
#include "tests/config_text.h"

namespace tacipc {
namespace {

constexpr double kMm = 1e-3;
constexpr double kDegree = std::numbers::pi / 180.0;

LayerStack stack_of(const std::vector<std::pair<double, double>>& layers) {
  LayerStack stack;
  for (const auto& [thickness, ior] : layers) stack.add(thickness, ior);
  return stack;
}

/// Air 3, acrylic 5, gel 2.
const LayerStack kMcTac = stack_of({{3.0, 1.0}, {5.0, 1.49}, {2.0, 1.41}});

LayeredPath<double> path_to(const LayerStack& stack, double r) {
  return layered_path<double>(stack, stack.thickness_m[static_cast<std::size_t>(stack.count - 1)], r * r);
}

TEST(LayeredPath, MatchesTheTableOfAnglesAndIrradiance) {
  struct Row {
    double r, air_deg, acrylic_deg, gel_deg, transmittance, irradiance;
  };
  for (const Row& row : {Row{5.0, 34.5, 22.4, 23.7, 0.9577, 0.011505}, Row{10.0, 58.9, 35.1, 37.4, 0.9169, 0.004954},
                         Row{15.0, 71.7, 39.6, 42.3, 0.807, 0.001516}}) {
    const auto path = path_to(kMcTac, row.r);
    const double p = row.r * path.sine_over_lateral;
    EXPECT_NEAR(std::asin(p) / kDegree, row.air_deg, 0.05) << row.r;
    EXPECT_NEAR(std::acos(path.cosine_first) / kDegree, row.air_deg, 0.05) << row.r;
    EXPECT_NEAR(std::asin(p / 1.49) / kDegree, row.acrylic_deg, 0.05) << row.r;
    EXPECT_NEAR(std::acos(path.cosine_last) / kDegree, row.gel_deg, 0.05) << row.r;
    EXPECT_NEAR(path.transmittance, row.transmittance, 1e-4 + 4e-4 * (row.r > 12.0)) << row.r;
    EXPECT_NEAR(path.transmittance * path.spread / row.irradiance, 1.0, 1e-4 + 3e-4 * (row.r > 12.0)) << row.r;
  }
}

TEST(LayeredPath, EqualIndicesAreAStraightLine) {
  const LayerStack stack = stack_of({{3.0, 1.3}, {5.0, 1.3}, {2.0, 1.3}});
  for (const double r : {0.0, 1e-9, 0.3, 7.0, 200.0}) {
    const auto path = path_to(stack, r);
    const double distance = std::hypot(10.0, r);
    EXPECT_NEAR(path.cosine_first * distance, 10.0, 1e-11);
    EXPECT_NEAR(path.spread * std::pow(distance, 3.0) / 10.0, 1.0, 1e-12);  // cos θ / d² per area of the plane
    EXPECT_EQ(path.transmittance, 1.0);
  }
}

TEST(LayeredPath, LeadsWhereSnellSendsIt) {
  // Also from a light inside the denser layer, and far to the side.
  for (const LayerStack& stack :
       {kMcTac, stack_of({{4.0, 1.49}, {2.0, 1.41}}), stack_of({{0.5, 1.0}, {9.0, 1.6}, {3.0, 1.2}})}) {
    for (const double r : {0.01, 1.0, 8.0, 25.0, 90.0}) {
      const double p = r * path_to(stack, r).sine_over_lateral;
      double reached = 0.0;
      for (int i = 0; i < stack.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        reached += stack.thickness_m[k] * std::tan(std::asin(p / stack.ior[k]));
      }
      EXPECT_NEAR(reached / r, 1.0, 1e-10) << r;
    }
  }
}

TEST(LayeredPath, PacksSayWhatNumbersSay) {
  Pack squared{}, thickness{};
  for (int l = 0; l < kLanes; ++l) {
    squared[l] = std::pow(0.4 + 2.1 * l, 2.0);
    thickness[l] = 1.0 + 0.1 * l;
  }
  const auto eight = layered_path<Pack>(kMcTac, thickness, squared);
  for (int l = 0; l < kLanes; ++l) {
    const auto one = layered_path<double>(kMcTac, thickness[l], squared[l]);
    EXPECT_NEAR(eight.spread[l] / one.spread, 1.0, 1e-10) << l;
    EXPECT_NEAR(eight.transmittance[l], one.transmittance, 1e-10) << l;
    EXPECT_NEAR(eight.cosine_last[l], one.cosine_last, 1e-10) << l;
  }
}

TEST(LayeredPath, FresnelAtNormalIncidenceAndTheWayBack) {
  // ((1.49 − 1) / (1.49 + 1))² = 0.03873
  EXPECT_NEAR(1.0 - path_to(stack_of({{3.0, 1.0}, {5.0, 1.49}}), 0.0).transmittance, 0.03873, 5e-6);
  const LayerStack back = stack_of({{2.0, 1.41}, {5.0, 1.49}, {3.0, 1.0}});
  for (const double r : {0.0, 4.0, 12.0}) {
    const auto there = path_to(kMcTac, r), returning = path_to(back, r);
    EXPECT_NEAR(there.transmittance, returning.transmittance, 1e-11);
    EXPECT_NEAR(there.sine_over_lateral, returning.sine_over_lateral, 1e-11);
    // Reciprocity of throughput: n² cos θ dω dA is the same from both ends.
    EXPECT_NEAR(there.spread * 1.0 * there.cosine_first / (returning.spread * 1.41 * 1.41 * returning.cosine_first),
                1.0, 1e-12);
  }
}

TEST(LayeredPath, CountedPhotonsAgree) {
  // Photons on a fine grid of cos θ, refracted interface by interface with vectors, counted on rings of the plane.
  constexpr int kPhotons = 2000000;
  constexpr double kHalfWidth = 0.05;
  const std::vector<double> radii = {2.0, 5.0, 10.0, 15.0};
  std::vector<double> power(radii.size(), 0.0);
  for (int k = 0; k < kPhotons; ++k) {
    double cosine = (k + 0.5) / kPhotons, sine = std::sqrt(1.0 - cosine * cosine), r = 0.0, carried = 1.0;
    for (int i = 0; i < kMcTac.count; ++i) {
      const auto layer = static_cast<std::size_t>(i);
      if (i > 0) {
        const double before = kMcTac.ior[layer - 1], after = kMcTac.ior[layer];
        const double bent = sine * before / after;
        const double in = std::asin(sine), out = std::asin(bent);
        const double rs = -std::sin(in - out) / std::sin(in + out), rp = std::tan(in - out) / std::tan(in + out);
        if (sine > 1e-3) carried *= 1.0 - 0.5 * (rs * rs + rp * rp);
        sine = bent;
        cosine = std::sqrt(1.0 - sine * sine);
      }
      r += kMcTac.thickness_m[layer] * sine / cosine;
    }
    for (std::size_t j = 0; j < radii.size(); ++j) power[j] += std::abs(r - radii[j]) < kHalfWidth ? carried : 0.0;
  }
  for (std::size_t j = 0; j < radii.size(); ++j) {
    const double area = 2.0 * std::numbers::pi * radii[j] * 2.0 * kHalfWidth;
    const double irradiance = power[j] * 2.0 * std::numbers::pi / kPhotons / area;  // I = 1: 2π over the half space
    const auto path = path_to(kMcTac, radii[j]);
    EXPECT_NEAR(irradiance / (path.transmittance * path.spread), 1.0, 0.01) << radii[j];
  }
}

OpticalStack mctac_stack() {
  return {.gel_thickness_m = 2.0 * kMm,
          .gel_ior = 1.41,
          .layers = {{.name = "acrylic", .thickness_m = 5.0 * kMm, .ior = 1.49}}};
}

Camera camera_of(Camera::Model model) {
  return {.position_m = {0.0, 0.0, -12.0 * kMm},
          .width_px = 640,
          .height_px = 480,
          .window_width_m = 15.0 * kMm,
          .window_height_m = 11.25 * kMm,
          .model = model};
}

TEST(OpticalStack, StartsInTheMediumThatHoldsTheLight) {
  const OpticalStack stack = mctac_stack();
  const LayerStack from_air = stack.from(-12.0 * kMm), from_acrylic = stack.from(-4.0 * kMm);
  ASSERT_EQ(from_air.count, 3);
  EXPECT_NEAR(from_air.thickness_m[0], 5.0 * kMm, 1e-15);
  EXPECT_EQ(from_air.ior[0], 1.0);
  EXPECT_EQ(from_air.ior[2], 1.41);
  ASSERT_EQ(from_acrylic.count, 2);
  EXPECT_NEAR(from_acrylic.thickness_m[0], 2.0 * kMm, 1e-15);
  EXPECT_EQ(from_acrylic.ior[0], 1.49);
}

TEST(CameraModel, RectifiedWindowIsLinearOnThePlane) {
  const CameraModel camera(camera_of(Camera::Model::rectified), mctac_stack());
  for (const auto& [column, row] : {std::pair{0.0, 0.0}, std::pair{640.0, 480.0}, std::pair{100.5, 300.25}}) {
    const Vector3 expected(15.0 * kMm * (column / 640 - 0.5), 11.25 * kMm * (row / 480 - 0.5), 0.0);
    const auto ray = camera.ray(column, row);
    ASSERT_TRUE(ray);
    const Vector3 at_plane = ray->origin - ray->direction * (ray->origin.z() / ray->direction.z());
    EXPECT_LT((at_plane - expected).norm(), 1e-15);
    EXPECT_NEAR(ray->direction.norm(), 1.0, 1e-12);
    const auto back = camera.project(expected);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - Eigen::Vector2d(column, row)).norm(), 1e-9);
  }
}

TEST(CameraModel, PinholeShowsTheWindowsEdgeAndCornersFurtherOut) {
  const CameraModel camera(camera_of(Camera::Model::pinhole), mctac_stack());
  const auto edge = camera.project({7.5 * kMm, 0.0, 0.0});
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->x(), 640.0, 1e-9);
  // Where a linear map would put the corner of the window lies the picture's corner, 400 px out; light bends it 3.7 %.
  const auto corner = camera.project({7.5 * kMm, 5.625 * kMm, 0.0});
  ASSERT_TRUE(corner);
  EXPECT_NEAR((*corner - Eigen::Vector2d(320, 240)).norm() / 400.0, 1.037, 5e-4);
  // 7 mm is seen 37.36° off the axis: f tan θ.
  const auto seven = camera.project({7.0 * kMm, 0.0, 0.0});
  EXPECT_NEAR(std::atan((seven->x() - 320.0) / camera.intrinsics_px()[0]) / kDegree, 37.36, 5e-3);
}

TEST(CameraModel, ProjectionUndoesTheRay) {
  Camera pinhole = camera_of(Camera::Model::pinhole), fisheye = camera_of(Camera::Model::fisheye);
  pinhole.radial = {-0.12, 0.03, 0.0};
  pinhole.tangential = {0.002, -0.001};
  pinhole.rotation_rad = {0.02, -0.03, 0.1};
  fisheye.radial = {0.05, -0.01, 0.0};
  fisheye.rotation_rad = {0.0, 0.02, -0.05};
  Camera turned = camera_of(Camera::Model::rectified);
  turned.rotation_rad = {0.0, 0.0, 0.2};
  for (const Camera& camera : {pinhole, fisheye, turned}) {
    for (const bool refract : {true, false}) {
      const CameraModel model(camera, mctac_stack(), refract);
      for (const auto& [column, row] : {std::pair{5.0, 470.0}, std::pair{320.0, 240.0}, std::pair{600.0, 31.0}}) {
        const auto ray = model.ray(column, row);
        ASSERT_TRUE(ray);
        for (const double z_mm : {0.0, -0.7}) {
          const Vector3 seen = ray->origin + ray->direction * ((z_mm * kMm - ray->origin.z()) / ray->direction.z());
          const auto back = model.project(seen);
          ASSERT_TRUE(back);
          EXPECT_LT((*back - Eigen::Vector2d(column, row)).norm(), 1e-6) << column << " " << z_mm << " " << refract;
        }
      }
    }
  }
}

TEST(CameraModel, FisheyeIsEquidistant) {
  Camera camera = camera_of(Camera::Model::fisheye);
  camera.intrinsics_px = {150.0, 150.0, 320.0, 240.0};
  const CameraModel model(camera, {.gel_thickness_m = 2e-3});
  const auto ray = model.ray(320.0 + 150.0 * 0.6, 240.0);
  EXPECT_NEAR(std::atan2(ray->direction.x(), ray->direction.z()), 0.6, 1e-12);
  EXPECT_FALSE(model.ray(320.0 + 150.0 * 1.6, 240.0));  // beyond 90°: looks away from the gel
}

TEST(CameraModel, RayIntoAThinnerMediumIsTotallyReflected) {
  const OpticalStack stack{
      .gel_thickness_m = 2e-3, .gel_ior = 1.0, .layers = {{.name = "glass", .thickness_m = 20e-3, .ior = 1.5}}};
  const CameraModel model(camera_of(Camera::Model::fisheye), stack);  // the camera sits in the glass
  EXPECT_TRUE(model.ray(320.0, 240.0));
  Camera wide = camera_of(Camera::Model::fisheye);
  wide.intrinsics_px = {300.0, 300.0, 320.0, 240.0};
  EXPECT_FALSE(CameraModel(wide, stack).ray(320.0 + 300.0 * 0.8, 240.0));  // 45.8° > asin(1/1.5) = 41.8°
}

TEST(Undistort, UndoesDistortion) {
  for (const Eigen::Vector2d& point :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.3, -0.2), Eigen::Vector2d(-0.6, 0.5)}) {
    const std::array<double, 3> radial = {-0.2, 0.05, 0.01};
    const std::array<double, 2> tangential = {0.003, -0.004};
    const auto back = undistort(distort(point, radial, tangential), radial, tangential);
    ASSERT_TRUE(back);
    EXPECT_LT((*back - point).norm(), 1e-13);
  }
  EXPECT_FALSE(undistort({2.0, 0.0}, {-0.5, 0.0, 0.0}, {}));  // r (1 − r²/2) never gets there
}

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

// What a sensor file may say of its optics ----------------------------------------------------------------------------

std::string sensor_text(const std::string& change, const std::string& by) {
  std::string text =
      "name: odd\n"
      "gel: {outline: disc, radius_mm: 15, thickness_mm: 2, ior: 1.41}\n"
      "layers: [{name: acrylic, thickness_mm: 5, ior: 1.49}]\n"
      "material: {law: neo_hookean, density_kg_m3: 1000, youngs_modulus_pa: 1e5, poissons_ratio: 0.4}\n"
      "coating: {albedo: [0.5, 0.5, 0.5]}\n"
      "leds: {list: [{position_mm: [9, 0, -12], cct_k: 5000, intensity: 1}]}\n"
      "camera: {position_mm: [0, 0, -12], width_px: 64, height_px: 48, window_mm: [8, 6]}\n"
      "response: {mean_level: 0.5, curve: srgb}\n";
  const std::size_t at = text.find(change);
  EXPECT_NE(at, std::string::npos) << change;
  return text.replace(at, change.size(), by);
}

TEST(Sensor, OpticsFaultsNameTheirPlace) {
  using ::testing::ElementsAre;
  const auto faults = [](const std::string& change, const std::string& by) {
    return faults_in<Sensor>(sensor_text(change, by), "odd.yaml");
  };
  EXPECT_THAT(faults("mean_level", "mean_level"), ElementsAre());
  EXPECT_THAT(
      faults("[9, 0, -12]", "[9, 0, -1]"),
      ElementsAre("odd.yaml:6:29: leds.list[0].position_mm: the LED lies inside the gel (which reaches to z = -2 mm)"));
  EXPECT_THAT(faults("[9, 0, -12]", "[19, 0, -1]"),
              ElementsAre("odd.yaml:6:29: leds.list[0].position_mm: the LED must lie behind the gel (z < -2 mm) where "
                          "light is refracted"));
  EXPECT_THAT(faults("position_mm: [0, 0, -12]", "position_mm: [80, 0, -12]"),
              ElementsAre("odd.yaml:7:23: camera.position_mm: the camera sees nothing of the gel"));
  EXPECT_THAT(faults("position_mm: [0, 0, -12]", "position_mm: [0, 0, -1]"),
              ElementsAre("odd.yaml:7:23: camera.position_mm: the camera must lie behind the gel (z < -2 mm)"));
  EXPECT_THAT(faults(", ior: 1.41", ""),
              ElementsAre("odd.yaml:2:6: gel.ior: missing: light is refracted where there are layers"));
  EXPECT_THAT(
      faults("window_mm: [8, 6]", "window_mm: [8, 6], horizontal_fov_deg: 60"),
      ElementsAre("odd.yaml:7:76: camera.window_mm: give one of window_mm, intrinsics_px and horizontal_fov_deg"));
  EXPECT_THAT(faults("camera: {", "camera: {model: rectified, distortion: {radial: [0.1, 0, 0]}, "),
              ElementsAre("odd.yaml:7:40: camera.distortion: a rectified picture has none"));
  EXPECT_THAT(faults("camera: {", "camera: {vignetting: {v2: -1.2}, "),
              ElementsAre("odd.yaml:7:22: camera.vignetting: leaves no light somewhere in the image"));
  EXPECT_THAT(faults("cct_k: 5000", "wavelength_nm: 620"), ElementsAre("odd.yaml:6:15: leds.list[0].fwhm_nm: missing"));
  EXPECT_THAT(faults("[0.5, 0.5, 0.5]", "[0.9, 0.5, 0.5], specular_f0: 0.2, ggx_alpha: 0.3"),
              ElementsAre("odd.yaml:5:49: coating.specular_f0: albedo and specular_f0 add up to more than 1"));
  EXPECT_THAT(faults("mean_level: 0.5", "mean_level: 0.5, exposure: 2"),
              ElementsAre("odd.yaml:8:24: response.mean_level: give either mean_level or exposure"));
  EXPECT_THAT(
      faults("leds: {", "leds: {diffuser: {inner_radius_mm: 8, outer_radius_mm: 7, z_mm: -5, transmittance: 1}, "),
      ElementsAre("odd.yaml:6:56: leds.diffuser.outer_radius_mm: must exceed inner_radius_mm",
                  "odd.yaml:6:65: leds.diffuser.z_mm: must lie behind gel and layers (z <= -7 mm)"));
}

TEST(Sensor, LightsOfOneGroupHaveOneColour) {
  const std::string two =
      "list: [{position_mm: [9, 0, -12], group: a, cct_k: 5000, intensity: 1}, {position_mm: [8, 0, -12], group: a, "
      "cct_k: 3000, intensity: 1}]";
  EXPECT_THAT(
      faults_in<Sensor>(sensor_text("list: [{position_mm: [9, 0, -12], cct_k: 5000, intensity: 1}]", two), "odd.yaml"),
      ::testing::ElementsAre("odd.yaml:6:114: leds.list[1].group: LEDs of the group a must have one colour"));
}

TEST(Sensor, SourcesAreInheritedCheckedAndNamed) {
  std::string text = sensor_text("radius_mm: 15, ", "radius_mm: 15, radius_mm_src: derived, ");
  text += "gel_src: known\nleds_src: guess\n";
  const auto sensor = config_from_text<Sensor>(text, "odd.yaml");
  const auto source = [&](const std::string& path) {
    for (const ValueSource& value : sensor.sources) {
      if (value.path == path) return value.source;
    }
    return std::string("no such value");
  };
  EXPECT_EQ(source("gel.radius_mm"), "derived");
  EXPECT_EQ(source("gel.thickness_mm"), "known");
  EXPECT_EQ(source("leds.list[0].position_mm"), "guess");
  EXPECT_EQ(source("camera.position_mm"), "unstated");
  EXPECT_THAT(faults_in<Sensor>(text + "camera_src: gess\nlayer_src: known\n", "odd.yaml"),
              ::testing::ElementsAre("odd.yaml:11:13: camera_src: 'gess' is not one of known, derived, guess",
                                     "odd.yaml:12:1: layer_src: there is no layer whose source this could be"));
}

TEST(Sensor, EveryShippedValueSaysWhereItComesFrom) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors")) {
    if (entry.path().extension() != ".yaml") continue;
    ++files;
    for (const ValueSource& value : read_config<Sensor>(entry.path()).sources) {
      const std::string key = value.path.substr(value.path.rfind('.') + 1);
      if (key == "name" || key == "group" || key == "reference_image") continue;
      EXPECT_NE(value.source, "unstated") << entry.path() << ": " << value.path;
    }
  }
  EXPECT_GE(files, 2);
}

TEST(Camera, FieldOfViewGivesTheWindowItSees) {
  const std::string text = sensor_text("window_mm: [8, 6]", "horizontal_fov_deg: 74.72");
  const auto sensor = config_from_text<Sensor>(text, "odd.yaml");
  EXPECT_NEAR(0.5 * sensor.camera.window_width_m, 7.0 * kMm, 2e-6);  // 37.36° to each side
}

}  // namespace
}  // namespace tacipc
