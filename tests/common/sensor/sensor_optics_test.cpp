// Optics of a sensor file: what is read, what is refused.
#include <gmock/gmock.h>

#include <numbers>

#include "common/sensor/layered_path.h"
#include "common/sensor/sensor.h"
#include "tests/config_text.h"

namespace tacipc {
namespace sensor_optics_test {

constexpr double kMm = 1e-3;
constexpr double kDegree = std::numbers::pi / 180.0;

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
      ElementsAre("odd.yaml:7:104: camera.horizontal_fov_deg: the file also has window_mm: give one of the two"));
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

TEST(Sensor, CameraFaultsNameTheKeysOfTheFile) {
  using ::testing::ElementsAre;
  const auto faults = [](const std::string& by) {
    return faults_in<Sensor>(sensor_text("window_mm: [8, 6]", by), "odd.yaml");
  };
  const std::string edges = "the edges of the picture do not see the plane of the front face";
  EXPECT_THAT(faults("intrinsics_px: [40, 40, 32, 24], rotation_deg: [75, 0, 0]"),
              ElementsAre("odd.yaml:7:80: camera.intrinsics_px: " + edges));
  EXPECT_THAT(faults("distortion: {radial: [-1, 0, 0]}, intrinsics_px: [40, 40, 32, 24]"),
              ElementsAre("odd.yaml:7:114: camera.intrinsics_px: " + edges));
  EXPECT_THAT(faults("horizontal_fov_deg: 60, rotation_deg: [0, 75, 0]"),
              ElementsAre("odd.yaml:7:85: camera.horizontal_fov_deg: " + edges));
  EXPECT_THAT(faults("intrinsics_px: [40, 40, 32, 24], horizontal_fov_deg: 60"),
              ElementsAre("odd.yaml:7:118: camera.horizontal_fov_deg: the file also has intrinsics_px: give one of the "
                          "two"));
  EXPECT_THAT(faults("model: rectified, intrinsics_px: [40, 40, 32, 24]"),
              ElementsAre("odd.yaml:7:98: camera.intrinsics_px: not of a rectified camera, which has a window instead "
                          "(window_mm)"));
  EXPECT_THAT(
      faults("model: pinhole"),
      ElementsAre("odd.yaml:7:9: camera.window_mm: give one of window_mm, intrinsics_px and horizontal_fov_deg"));
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

}  // namespace sensor_optics_test
}  // namespace tacipc
