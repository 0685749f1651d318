#include "stages/study/identify/fitted_sensor.h"

#include <gmock/gmock.h>

#include "tests/stages/study/identify/made_up_sensor.h"

namespace tacipc {
namespace fitted_sensor_test {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string kSensor = R"(name: made_up
gel:
  outline: disc
  radius_mm: 15
  thickness_mm: 4           # of the mould
gel_src: known
material:
  law: neo_hookean
  law_src: guess
  density_kg_m3: 1000       # paper
  youngs_modulus_pa: 2.0e+5 # as read
  poissons_ratio: 0.47
material_src: known
)" + kMadeUpOptics;

/// What two draws leave of a modulus and of a mount.
IdentifyResult result_of(const MechanicsModel& model) {
  Posterior posterior{.u = Eigen::MatrixXd(2, 2), .weight = Eigen::Vector2d(0.5, 0.5), .effective_draws = 2.0};
  posterior.u << std::log(1.0e5), std::log(1.21e5), 0.01, 0.03;
  const Fit fit{.u = posterior.mean_u(), .covariance = Eigen::Matrix2d::Identity()};
  return {
      .model = model,
      .fit = fit,
      .posterior = posterior,
      .u = posterior.mean_u(),
      .estimates = {{.name = kModulus, .measurement = "", .value = 1.1e5, .sigma = 1.05e4, .prior = {}, .told = true},
                    {.name = kMount, .measurement = "", .value = 0.02, .sigma = 0.01, .prior = {}}},
      .forces = {},
      .modulus_error = {},
      .markers = {}};
}

struct Made {
  MechanicsModel model{made_up_spec("  youngs_modulus_pa: {mean: 2.0e+5, factor: 2}\n"
                                    "  mount_compliance_mm_per_n: {mean: 0.01, sigma: 0.02, bounds: [0, 0.2]}\n",
                                    made_up_press("ball", 4.0)),
                       {{.force = ForceData{}, .markers = {}}},
                       made_up_sensor()};
};

TEST(FittedSensor, SaysOfEveryValueOfTheMechanicsWhereItComesFrom) {
  const Made made;
  const std::string text = fitted_sensor(kSensor, "s.yaml", result_of(made.model));
  EXPECT_THAT(text, HasSubstr("  youngs_modulus_pa: 110000  # [fitted ± 1e+04]\n"));
  EXPECT_THAT(text, HasSubstr("  youngs_modulus_pa_src: derived\n"));
  EXPECT_THAT(text, HasSubstr("  compliance_mm_per_n: 0.02  # [fitted ± 0.01, by its prior]\n"));
  EXPECT_THAT(text, HasSubstr("  thickness_mm: 4  # [measured] of the mould\n"));
  EXPECT_THAT(text, HasSubstr("  law: neo_hookean  # [guess]\n"));
  EXPECT_THAT(text, HasSubstr("  density_kg_m3: 1000  # [measured] paper\n"));
  EXPECT_THAT(text, Not(HasSubstr("as read")));
  EXPECT_EQ(fitted_sensor(text, "s.yaml", result_of(made.model)).find("[measured] [measured]"), std::string::npos);
}

TEST(EnsembleOf, HasOneMemberPerEvenShareOfTheDraws) {
  const Made made;
  const Ensemble ensemble = ensemble_of(result_of(made.model), "out/sensor.yaml", 2);
  ASSERT_EQ(ensemble.members.size(), 2U);
  EXPECT_EQ(ensemble.members[0].name, "m00");
  EXPECT_THAT(ensemble.members[1].set, testing::ElementsAre(testing::Pair("material.youngs_modulus_pa", "121000"),
                                                            testing::Pair("mount.compliance_mm_per_n", "0.03")));
}

}  // namespace fitted_sensor_test
}  // namespace tacipc
