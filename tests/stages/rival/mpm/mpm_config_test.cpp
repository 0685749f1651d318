#include "stages/rival/mpm/mpm_config.h"

#include <gmock/gmock.h>

#include "tests/config_text.h"

namespace tacipc {
namespace {

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
    EXPECT_EQ(config.object.samples, 100000);
    EXPECT_TRUE(config.depth_of_gel);
    EXPECT_EQ(config.check_every, 2);
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

TEST(MpmConfig, NamesWhatIsWrong) {
  const std::string text =
      "gel: {lattice: block, counts: [3.5, 2, 2], spacing_mm: 0, particles: inside, glued: layers, fixed_layers: 0}\n"
      "grid: {spacing_mm: 0.2}\n"
      "time: {step_s: 1e-4, courant: 0.3}\n"
      "object: {samples: 5, samples_per_mm2: 3, mass_ratio: 1, press_speed_mm_s: 1, move_speed_mm_s: 1, start_gap_mm: "
      "0}\n"
      "motion: {depth_of: gel, hold_frame_s: 1e-3}\n"
      "pixels: ends\n"
      "half_speed: {largest_change: 0}\n";
  EXPECT_THAT(faults_in<MpmConfig>(text, "x.yaml"),
              ElementsAre("x.yaml:1:31: gel.counts: must be whole numbers",
                          "x.yaml:1:56: gel.spacing_mm: 0 is outside (0, inf)",
                          "x.yaml:1:107: gel.fixed_layers: 0 is outside [1, 4096]",
                          "x.yaml:3:31: time.courant: give step_s or courant, not both",
                          "x.yaml:4:19: object.samples: give samples or samples_per_mm2, not both",
                          "x.yaml:7:30: half_speed.largest_change: 0 is outside (0, inf)"));
}

}  // namespace
}  // namespace tacipc
