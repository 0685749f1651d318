#include "stages/rival/mpm/mpm_config.h"

#include <gmock/gmock.h>

#include "tests/config_text.h"

namespace tacipc {
namespace mpm_config_test {

using ::testing::ElementsAre;

MpmConfig shipped(const std::string& name) {
  return read_config<MpmConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/rivals/mpm/" + name + ".yaml");
}

TEST(MpmConfig, LegacyHasThePublishedConstants) {
  for (const std::string name : {"legacy", "legacy_mctac"}) {
    const MpmConfig config = shipped(name);
    EXPECT_EQ(config.grid_spacing_m, 1e-3 * 33.0 / 256.0);
    EXPECT_EQ(config.gel.volume_m3, 1e-9 * (33.0 / 512.0) * (33.0 / 512.0));
    EXPECT_EQ(config.gel.spacing_m, 0.2e-3);
    EXPECT_EQ(config.gel.fixed_layers, 3);
    EXPECT_TRUE(config.gel.on_faces);
    EXPECT_EQ(config.density_kg_m3, 1e6) << "1 g/mm3";
    EXPECT_EQ(config.step_s, 1e-4);
    EXPECT_EQ(config.damping_per_s, 0.0);
    EXPECT_EQ(config.object.press_speed_m_s, 0.2);
    EXPECT_EQ(config.object.mass_ratio, 1.0);
    EXPECT_EQ(config.object.samples_per_m2, 600e6) << "1e6 on 1650 mm2";
    EXPECT_EQ(config.object.start_gap_m, 1e-3);
    EXPECT_EQ(config.frame_within_m, 1e-6);
    EXPECT_TRUE(config.depth_of_gel);
    EXPECT_EQ(config.check_every, 1);
    EXPECT_TRUE(config.pixels_at_ends);
    EXPECT_FALSE(config.largest_change);
  }
  const MpmConfig block = shipped("legacy");
  EXPECT_EQ(block.gel.counts, (std::array{101, 101, 21}));
  EXPECT_EQ(block.youngs_modulus_pa, 1.45e5);
  EXPECT_EQ(block.poissons_ratio, 0.45);
  EXPECT_FALSE(shipped("legacy_mctac").gel.counts);
  EXPECT_FALSE(shipped("legacy_mctac").youngs_modulus_pa);
}

TEST(MpmConfig, PhysicalTakesTheSensorsMaterialAndAStepByTheWave) {
  for (const std::string name : {"physical", "physical_checked", "coarse_checked"}) {
    const MpmConfig config = shipped(name);
    EXPECT_FALSE(config.density_kg_m3);
    EXPECT_FALSE(config.gel.volume_m3);
    EXPECT_FALSE(config.step_s);
    EXPECT_GT(config.courant, 0.0);
    EXPECT_EQ(config.largest_change.has_value(), name != "physical");
  }
  EXPECT_EQ(shipped("physical_checked").largest_change, 0.02);
  EXPECT_EQ(shipped("coarse_checked").largest_change, 0.02);
}

TEST(MpmConfig, HasTheThreePublishedCriteriaOfAFrameByName) {
  const auto within_m = [](const std::string& criterion) {
    return config_from_text<MpmConfig>(
               "gel: {lattice: sensor, spacing_mm: 0.2, particles: inside, glued: nodes}\ngrid: {spacing_mm: 0.2}\n"
               "time: {step_s: 1e-4}\nobject: {samples_per_mm2: 6, mass_ratio: 1, press_speed_mm_s: 1, "
               "move_speed_mm_s: 1, start_gap_mm: 0}\npixels: ends\n"
               "motion: {depth_of: gel, hold_frame_s: 1e-3" +
                   criterion + "}\n",
               "x.yaml")
        .frame_within_m;
  };
  EXPECT_EQ(within_m(""), 0.0);
  EXPECT_EQ(within_m(", frame_criterion: beyond"), 0.0);
  EXPECT_EQ(within_m(", frame_criterion: within_1um"), 1e-6);
  EXPECT_EQ(within_m(", frame_criterion: within_10um"), 1e-5);
  EXPECT_EQ(within_m(", frame_criterion: within_100um"), 1e-4);
  EXPECT_THAT(faults_of([&] { within_m(", frame_criterion: near"); }),
              ElementsAre(::testing::StartsWith("x.yaml:6:62: motion.frame_criterion: ")));
}

TEST(MpmConfig, TheStudyOfPhotographsLooksAsOftenInTimeAsPublished) {
  const auto study =
      read_config<MpmConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/studies/sim2real/gelsight_sim2real/mpm.yaml");
  const MpmConfig legacy = shipped("legacy");
  EXPECT_DOUBLE_EQ(study.check_every * *study.step_s, legacy.check_every * *legacy.step_s);
  EXPECT_EQ(study.object.samples_per_m2, legacy.object.samples_per_m2);
  EXPECT_EQ(study.object.start_gap_m, legacy.object.start_gap_m);
  EXPECT_EQ(study.frame_within_m, legacy.frame_within_m);
}

TEST(MpmConfig, NamesWhatIsWrong) {
  const std::string text =
      "gel: {lattice: block, counts: [3.5, 2, 2], spacing_mm: 0, particles: inside, glued: layers, fixed_layers: 0}\n"
      "grid: {spacing_mm: 0.2}\n"
      "time: {step_s: 1e-4, courant: 0.3}\n"
      "object: {samples_per_mm2: 0, mass_ratio: 1, press_speed_mm_s: 1, move_speed_mm_s: 1, start_gap_mm: "
      "0}\n"
      "motion: {depth_of: gel, hold_frame_s: 1e-3}\n"
      "pixels: ends\n"
      "half_speed: {largest_change: 0}\n";
  EXPECT_THAT(faults_in<MpmConfig>(text, "x.yaml"),
              ElementsAre("x.yaml:1:31: gel.counts: must be whole numbers",
                          "x.yaml:1:56: gel.spacing_mm: 0 is outside (0, inf)",
                          "x.yaml:1:107: gel.fixed_layers: 0 is outside [1, 4096]",
                          "x.yaml:3:31: time.courant: give step_s or courant, not both",
                          "x.yaml:4:27: object.samples_per_mm2: 0 is outside (0, inf)",
                          "x.yaml:7:30: half_speed.largest_change: 0 is outside (0, inf)"));
}

}  // namespace mpm_config_test
}  // namespace tacipc
