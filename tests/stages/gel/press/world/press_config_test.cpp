#include "stages/gel/press/world/press_config.h"

#include <gmock/gmock.h>

#include "tests/config_text.h"

namespace tacipc {
namespace press_config_test {

using ::testing::ElementsAre;

TEST(PressConfig, ShippedSettingsAreThePapers) {
  const auto config = read_config<PressConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/press/paper.yaml");
  EXPECT_EQ(config.time_step_s, 0.01);
  EXPECT_EQ(config.relative_d_hat, 1e-3);
  EXPECT_EQ(config.barrier_stiffness, 1e6);
  EXPECT_EQ(config.newton.max_iterations, 200);
  EXPECT_FALSE(config.friction);
}

TEST(PressConfig, TakesTheFrictionOfASensorWhereItHasAny) {
  const auto read = [](const std::string& friction) {
    return config_from_text<PressConfig>(
        "time_step_s: 0.01\nnewton: {}\nbarrier: {relative_d_hat: 1e-3, stiffness: 1e6}\n" + friction, "x.yaml");
  };
  Sensor sensor;
  const PressConfig rough = read("friction: {coefficient: 0.4, relative_speed_threshold: 2e-3}\n");
  EXPECT_FALSE(rough.takes_friction_of(sensor));
  EXPECT_EQ(rough.with_friction_of(sensor).coefficient_of_friction(), 0.4);
  sensor.friction = 0.9;
  EXPECT_TRUE(rough.takes_friction_of(sensor));
  EXPECT_EQ(rough.with_friction_of(sensor).coefficient_of_friction(), 0.9);
  EXPECT_EQ(rough.with_friction_of(sensor).friction->relative_speed_threshold, 2e-3);
  for (const char* none : {"", "friction: {coefficient: 0}\n"}) {
    EXPECT_FALSE(read(none).takes_friction_of(sensor)) << none;
    EXPECT_EQ(read(none).with_friction_of(sensor).coefficient_of_friction(), 0.0) << none;
  }
}

TEST(PressConfig, ContactHessianIsAdaptiveUnlessNamed) {
  const auto read = [](const std::string& newton) {
    return config_from_text<PressConfig>(
        "time_step_s: 0.01\nnewton: {" + newton + "}\nbarrier: {relative_d_hat: 1e-3, stiffness: 1e6}\n", "x.yaml");
  };
  EXPECT_TRUE(read("").newton.adaptive_contact_hessian);
  EXPECT_TRUE(read("contact_hessian: adaptive").newton.adaptive_contact_hessian);
  EXPECT_FALSE(read("contact_hessian: positive").newton.adaptive_contact_hessian);
  EXPECT_THAT(faults_in<PressConfig>("time_step_s: 0.01\nnewton: {contact_hessian: exact}\n"
                                     "barrier: {relative_d_hat: 1e-3, stiffness: 1e6}\n",
                                     "x.yaml"),
              ElementsAre("x.yaml:2:27: newton.contact_hessian: 'exact' is not one of adaptive, positive"));
}

TEST(PressConfig, StressIsMeasuredWhereItIsWantedButNotWithDampingByStiffness) {
  const std::string rest = "time_step_s: 0.01\nnewton: {}\nbarrier: {relative_d_hat: 1e-3, stiffness: 1e6}\n";
  EXPECT_FALSE(config_from_text<PressConfig>(rest, "x.yaml").stress);
  EXPECT_TRUE(config_from_text<PressConfig>(rest + "stress: true\ndamping: {mass_per_s: 2}\n", "x.yaml").stress);
  EXPECT_THAT(
      faults_in<PressConfig>(rest + "damping: {stiffness_s: 1e-3}\nstress: true\n", "x.yaml"),
      ElementsAre("x.yaml:5:9: stress: is not measured with damping.stiffness_s, a damping of elements that has "
                  "no stress of its own"));
}

TEST(PressConfig, BarrierStiffnessAdaptsUnlessItIsGiven) {
  const auto read = [](const std::string& barrier) {
    return config_from_text<PressConfig>(
        "time_step_s: 0.01\nnewton: {}\nbarrier: {relative_d_hat: 1e-3" + barrier + "}\n", "x.yaml");
  };
  EXPECT_TRUE(read("").adaptive_barrier_stiffness);
  EXPECT_FALSE(read("").barrier_stiffness);
  EXPECT_EQ(read("").relative_barrier_stiffness, 0.2);
  EXPECT_FALSE(read(", stiffness: 1e6").adaptive_barrier_stiffness);
  EXPECT_FALSE(read(", relative_stiffness: 0.6").adaptive_barrier_stiffness);
  EXPECT_TRUE(read(", relative_stiffness: 0.6, adaptive: true").adaptive_barrier_stiffness);
  EXPECT_FALSE(read(", adaptive: false").adaptive_barrier_stiffness);
}

TEST(PressConfig, StartGapMustExceedDHat) {
  EXPECT_THAT(
      faults_in<PressConfig>(
          "time_step_s: 0.01\nnewton: {}\nbarrier: {relative_d_hat: 1e-3, stiffness: 1e6, start_gap_d_hat: 1}\n",
          "x.yaml"),
      ElementsAre("x.yaml:3:66: barrier.start_gap_d_hat: 1 is outside (1, 100]"));
}

}  // namespace press_config_test
}  // namespace tacipc
