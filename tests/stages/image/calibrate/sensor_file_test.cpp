#include "stages/image/calibrate/sensor_file.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "common/sensor/sensor.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace sensor_file_test {

const std::string kSensorText = R"(# what is known of it
name: tiny
gel: {outline: disc, radius_mm: 15.0, radius_mm_src: known, thickness_mm: 2, ior: 1.41}
material: {law: neo_hookean, density_kg_m3: 1010, youngs_modulus_pa: 1.23e5, poissons_ratio: 0.43}
coating: {albedo: [0.5, 0.50, 0.5]}
leds:
  list:
    - {cct_k: 4000, cct_k_src: known, intensity: 1.0, position_mm: [9, 0, -13], normal: [0, 0, 1]}
    - {rgb_linear: [0, 1, 0], intensity: 1.0, position_mm: [-9, 0, -13]}
camera:
  model: rectified
  position_mm: [0, 0, -12]
  width_px: 8
  height_px: 6
  window_mm: [15.0, 11.25]
camera_src: guess
response: {mean_level: 0.45, curve: srgb, curve_src: guess}
noise: {full_well_e: 5000, read_e: 4}
)";

class SensorFile : public testing::Test {
 protected:
  std::string change(const std::vector<SensorChange>& changes) {
    return changed_sensor(scratch_.file("sensor.yaml", kSensorText), changes, "made by a test");
  }
  const ScratchFolder scratch_;
};

TEST_F(SensorFile, ChangesWhatItIsToldAndKeepsTheRest) {
  const std::string text = change({{"leds.list[0].cct_k", std::nullopt},
                                   {"leds.list[0].rgb_linear", Value::List{0.25, 1.5e-7, 0.0}},
                                   {"camera.vignetting.v2", -0.125},
                                   {"camera.rotation_deg", Value::List{0, 0, 1.5}},
                                   {"response.mean_level", std::nullopt},
                                   {"response.exposure", 1},
                                   {"response.white_balance", std::nullopt},
                                   {"response.curve", "gamma"},
                                   {"response.gamma", 2.0},
                                   {"reference_image", "reference.png", "known"}});
  EXPECT_EQ(text, R"(# made by a test
name: tiny
gel:
  outline: disc
  radius_mm: 15.0
  radius_mm_src: known
  thickness_mm: 2
  ior: 1.41
material:
  law: neo_hookean
  density_kg_m3: 1010
  youngs_modulus_pa: 1.23e5
  poissons_ratio: 0.43
coating:
  albedo: [0.5, 0.50, 0.5]
leds:
  list:
    - intensity: 1.0
      position_mm: [9, 0, -13]
      normal: [0, 0, 1]
      rgb_linear: [0.25, 1.5e-07, 0]
      rgb_linear_src: derived
    - rgb_linear: [0, 1, 0]
      intensity: 1.0
      position_mm: [-9, 0, -13]
camera:
  model: rectified
  position_mm: [0, 0, -12]
  width_px: 8
  height_px: 6
  window_mm: [15.0, 11.25]
  vignetting:
    v2: -0.125
    v2_src: derived
  rotation_deg: [0, 0, 1.5]
  rotation_deg_src: derived
camera_src: guess
response:
  curve: gamma
  curve_src: derived
  exposure: 1
  exposure_src: derived
  gamma: 2
  gamma_src: derived
noise:
  full_well_e: 5000
  read_e: 4
reference_image: reference.png
reference_image_src: known
)");
  const auto sensor = config_from_text<Sensor>(text, "out/sensor.yaml");
  EXPECT_EQ(sensor.leds[0].rgb, (std::array{0.25, 1.5e-7, 0.0}));
  EXPECT_EQ(*sensor.reference_image, "out/reference.png");
}

TEST_F(SensorFile, WithoutChangesItSaysTheSame) {
  const std::string once = change({});
  EXPECT_EQ(changed_sensor(scratch_.file("again.yaml", once), {}, "made by a test"), once);
}

TEST_F(SensorFile, RefusesWhatMakesNoSensor) {
  EXPECT_EQ(
      message_of<DataError>([&] {
        change({{"leds.list[0].position_mm", Value::List{0, 0, -1}}});
      }),
      "what was fitted makes no valid sensor:\n"
      "the fitted sensor:21:20: leds.list[0].position_mm: the LED lies inside the gel (which reaches to z = -2 mm)");
  EXPECT_EQ(message_of<DataError>([&] {
              change({{"leds.list[2].intensity", 1.0}});
            }),
            "leds.list[2].intensity: the sensor file has no such item");
  EXPECT_EQ(message_of<DataError>([&] {
              change({{"name.first", 1.0}});
            }),
            "name.first: the sensor file has no map there");
}

}  // namespace sensor_file_test
}  // namespace tacipc
