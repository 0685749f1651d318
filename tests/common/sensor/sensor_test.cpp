#include "common/sensor/sensor.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cmath>

#include "common/base/files.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace sensor_test {

TEST(Sensor, ShippedMcTacReadsWithThePapersNumbers) {
  const auto sensor = read_config<Sensor>(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/mctac.yaml");
  EXPECT_DOUBLE_EQ(sensor.gel.radius_m, 0.015);
  EXPECT_DOUBLE_EQ(sensor.gel.thickness_m, 0.002);
  EXPECT_EQ(sensor.leds.size(), 5u);
  // LED 1 of 8 sits at 45 degrees from x towards y (image down), behind the gel.
  EXPECT_NEAR(sensor.leds[0].position_m.x(), 0.01 * std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(sensor.leds[0].position_m.y(), 0.01 * std::sqrt(0.5), 1e-15);
  EXPECT_DOUBLE_EQ(sensor.leds[0].position_m.z(), -0.013);
}

TEST(Material, LameParametersByHand) {
  const Material gel{.law = "neo_hookean", .density_kg_m3 = 1010, .youngs_modulus_pa = 1.23e5, .poissons_ratio = 0.43};
  EXPECT_NEAR(gel.lame_mu_pa(), 1.23e5 / 2.86, 1e-9);
  EXPECT_NEAR(gel.lame_lambda_pa(), 1.23e5 * 0.43 / (1.43 * 0.14), 1e-9);
}

TEST(GelShape, DomeFrontLiesOnItsSphere) {
  const GelShape gel{.radius_m = 0.01, .thickness_m = 0.004, .dome_radius_m = 0.03};
  for (const double r : {0.0, 1e-6, 0.004, 0.0099}) {
    const double z = gel.front_z(r, 0.0) + 0.03;
    EXPECT_NEAR(std::hypot(r, z), 0.03, 1e-17 + 1e-15 * 0.03);
  }
}

TEST(MarkerGrid, OfMcTacIsNineteenByNineteenAtOneMillimetre) {
  const auto sensor = read_config<Sensor>(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/mctac.yaml");
  EXPECT_TRUE(sensor.markers.given);
  EXPECT_EQ(sensor.markers.rows * sensor.markers.columns, 361);
  EXPECT_DOUBLE_EQ(sensor.markers.x_m(0), -9e-3);
  EXPECT_EQ(sensor.markers.x_m(9), 0.0);
  EXPECT_DOUBLE_EQ(sensor.markers.y_m(18), 9e-3);
}

TEST(MarkerGrid, IsReadInMillimetresAndItsFaultsHaveAPlace) {
  const auto grid = config_from_text<MarkerGrid>("{rows: 2, columns: 3, pitch_mm: 0.5, center_mm: [1, -2]}", "m.yaml");
  EXPECT_TRUE(grid.given);
  EXPECT_DOUBLE_EQ(grid.x_m(0), 0.5e-3);
  EXPECT_DOUBLE_EQ(grid.x_m(2), 1.5e-3);
  EXPECT_DOUBLE_EQ(grid.y_m(0), -2.25e-3);

  EXPECT_THAT(
      faults_in<MarkerGrid>("rows: 0\npitch_mm: 0\nspacing: 1\n", "m.yaml"),
      ::testing::ElementsAre("m.yaml:1:7: rows: 0 is outside [1, 1000]", "m.yaml:2:11: pitch_mm: 0 is outside (0, inf)",
                             "m.yaml:3:1: spacing: unknown key"));
}

TEST(Material, LawIsOneOfTwoAndIncompressibilityIsOutOfReach) {
  for (const char* law : {"neo_hookean", "stvk_hencky"}) {
    const auto material = config_from_text<Material>(
        fmt::format("law: {}\ndensity_kg_m3: 1000\nyoungs_modulus_pa: 1e5\npoissons_ratio: 0.4999\n", law), "m.yaml");
    EXPECT_EQ(material.law, law);
    EXPECT_NEAR(material.lame_lambda_pa(), 1e5 * 0.4999 / (1.4999 * 0.0002), 1e-2);
  }
  EXPECT_THAT(
      faults_in<Material>("law: stvk\ndensity_kg_m3: 1000\nyoungs_modulus_pa: 1e5\npoissons_ratio: 0.5\n", "m.yaml"),
      ::testing::ElementsAre("m.yaml:1:6: law: 'stvk' is not one of neo_hookean, stvk_hencky",
                             "m.yaml:4:17: poissons_ratio: 0.5 is outside [0, 0.4999]"));
}

/// As in a sensor's file, values may say where they come from.
TEST(Material, MayBeAFileOfItsOwn) {
  const ScratchFolder scratch;
  const std::string keys =
      "law: stvk_hencky\nlaw_src: guess\ndensity_kg_m3: 300\nyoungs_modulus_pa: 2e4\npoissons_ratio: 0.3\n"
      "relaxation: [{part: 0.1, time_s: 0.5}]\nrelaxation_src: derived\n";
  const auto foam = read_config<Material>(scratch.file("foam.yaml", keys));
  EXPECT_EQ(foam.law, "stvk_hencky");
  EXPECT_EQ(foam.density_kg_m3, 300.0);
  EXPECT_EQ(foam.youngs_modulus_pa, 2e4);
  EXPECT_EQ(foam.relaxation.size(), 1u);
  EXPECT_THAT(faults_in<Material>(keys + "density_kg_m3_src: hearsay\ncolour: red\n", "m.yaml"),
              ::testing::ElementsAre("m.yaml:8:20: density_kg_m3_src: 'hearsay' is not one of known, derived, guess",
                                     "m.yaml:9:1: colour: unknown key"));
}

TEST(Material, RelaxationIsAPronySeriesThatLeavesSomeOfTheModulus) {
  const std::string elastic = "law: neo_hookean\ndensity_kg_m3: 1000\nyoungs_modulus_pa: 1e5\npoissons_ratio: 0.4\n";
  EXPECT_TRUE(config_from_text<Material>(elastic, "m.yaml").relaxation.empty());
  const auto gel = config_from_text<Material>(
      elastic + "relaxation: [{part: 0.1, time_s: 0.5}, {part: 0.25, time_s: 20}]\n", "m.yaml");
  ASSERT_EQ(gel.relaxation.size(), 2u);
  EXPECT_EQ(gel.relaxation[0].part, 0.1);
  EXPECT_EQ(gel.relaxation[1].time_s, 20.0);
  EXPECT_THAT(faults_in<Material>(elastic + "relaxation:\n  - {part: 0, time_s: 1}\n  - {part: 0.1, time_s: -1}\n"
                                            "  - {part: 0.1, tau_s: 1, time_s: 1}\n  - {part: 0.1}\n",
                                  "m.yaml"),
              ::testing::ElementsAre("m.yaml:6:12: relaxation[0].part: 0 is outside (0, 1)",
                                     "m.yaml:7:25: relaxation[1].time_s: -1 is outside (0, 1000000000]",
                                     "m.yaml:8:17: relaxation[2].tau_s: unknown key",
                                     "m.yaml:9:5: relaxation[3].time_s: missing"));
  EXPECT_THAT(faults_in<Material>(elastic + "relaxation: [{part: 0.4, time_s: 1}, {part: 0.6, time_s: 2}]\n", "m.yaml"),
              ::testing::ElementsAre("m.yaml:5:13: relaxation: its parts sum to 1, which must be less than 1"));
  EXPECT_THAT(faults_in<Material>(elastic + "relaxation: {part: 0.4, time_s: 1}\n", "m.yaml"),
              ::testing::ElementsAre("m.yaml:5:13: relaxation: expected a list of maps, found a map"));
}

/// A shipped sensor's text with some of it replaced.
std::string changed_mctac(const std::string& part, const std::string& by) {
  std::string text = read_file(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/mctac.yaml");
  return text.replace(text.find(part), part.size(), by);
}

TEST(Sensor, MountIsRigidAndFrictionThatOfThePressUnlessGiven) {
  const auto plain = read_config<Sensor>(std::string(TACIPC_SOURCE_DIR) + "/configs/sensors/mctac.yaml");
  EXPECT_FALSE(plain.mount.gives_way());
  EXPECT_FALSE(plain.friction);
  const auto sensor =
      config_from_text<Sensor>(changed_mctac("\nmaterial:",
                                             "\nmount: {compliance_mm_per_n: 0.01, compliance_mm_per_n_src: derived, "
                                             "shear_compliance_mm_per_n: 0.02}\nmaterial:"),
                               "s.yaml");
  EXPECT_TRUE(sensor.mount.gives_way());
  EXPECT_LT((sensor.mount.compliance() - Vector3(2e-5, 2e-5, 1e-5)).norm(), 1e-18);
  const auto across = config_from_text<Sensor>(
      changed_mctac("\nmaterial:", "\nmount: {shear_compliance_mm_per_n: 0.02}\nmaterial:"), "s.yaml");
  EXPECT_TRUE(across.mount.gives_way());
  EXPECT_EQ(across.mount.compliance_m_per_n, 0.0);
  const auto rough = config_from_text<Sensor>(changed_mctac("\ngel:\n", "\ngel:\n  friction: 0.85\n"), "s.yaml");
  EXPECT_EQ(rough.friction, 0.85);
  EXPECT_THAT(
      faults_in<Sensor>(changed_mctac("\nmaterial:", "\nmount: {compliance_mm_per_n: -1, stiffness: 3}\nmaterial:"),
                        "s.yaml"),
      ::testing::ElementsAre(::testing::HasSubstr("mount.compliance_mm_per_n: -1 is outside [0, 1000]"),
                             ::testing::HasSubstr("mount.stiffness: unknown key")));
  EXPECT_THAT(faults_in<Sensor>(changed_mctac("\ngel:\n", "\ngel:\n  friction: 11\n"), "s.yaml"),
              ::testing::ElementsAre(::testing::HasSubstr("gel.friction: 11 is outside [0, 10]")));
  EXPECT_THAT(faults_in<Sensor>(changed_mctac("\nmaterial:\n", "\nmaterial:\n  friction: 0.5\n"), "s.yaml"),
              ::testing::ElementsAre(::testing::HasSubstr("material.friction: unknown key")));
}

TEST(Sensor, FaultsOfMeaningNameTheirPlace) {
  const std::string text =
      "name: odd\n"
      "gel: {outline: disc, radius_mm: 15, thickness_mm: 2, dome_radius_mm: 20}\n"
      "material: {law: neo_hookean, density_kg_m3: 1000, youngs_modulus_pa: 1e5, poissons_ratio: 0.4}\n"
      "coating: {albedo: [0.5, 0.5, 0.5]}\n"
      "leds:\n"
      "  list:\n"
      "    - {position_mm: [0, 0, -9], intensity: 1}\n"
      "camera: {position_mm: [0, 0, 12], width_px: 64, height_px: 48, window_mm: [8, 6]}\n"
      "response: {mean_level: 0.5, curve: srgb}\n";
  EXPECT_THAT(
      faults_in<Sensor>(text, "odd.yaml"),
      ::testing::ElementsAre("odd.yaml:2:51: gel.thickness_mm: must exceed the dome's sag, 6.771 mm",
                             "odd.yaml:7:7: leds.list[0].rgb_linear: give one of rgb_linear, cct_k and wavelength_nm",
                             "odd.yaml:8:23: camera.position_mm: the camera must lie behind the front face (z < 0)"));
}

}  // namespace sensor_test
}  // namespace tacipc
