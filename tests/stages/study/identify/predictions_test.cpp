#include "stages/study/identify/predictions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/stages/study/identify/made_up_sensor.h"

namespace tacipc {
namespace predictions_test {

/// A press whose force is E x² in units of 1e-5 N/Pa, measured exactly at 0.5 and 1 mm with these deviations.
MechanicsModel model_with(double shallow_sigma_n, double deep_sigma_n) {
  const IdentifySpec spec = made_up_spec("  youngs_modulus_pa: {mean: 2.0e+5, factor: 2}\n",
                                         made_up_press("ball", 4.0, ", fit_to_mm: 1, predict_mm: [1.5]"));
  ForceData data;
  data.press.exponent = 0.5;
  data.press.y = Eigen::MatrixXd::Zero(1, 21);
  for (int i = 0; i <= 20; ++i) {
    data.press.x.push_back(0.1 * i);
    data.press.y(0, i) = 1e-5 * std::pow(0.1 * i, 2);
  }
  data.fitted = {{.at = 0.5, .force_n = 0.5, .sigma_n = shallow_sigma_n},
                 {.at = 1.0, .force_n = 2.0, .sigma_n = deep_sigma_n}};
  data.held_out = {{.at = 1.2, .force_n = 2.88, .sigma_n = 0.02}};
  return MechanicsModel(spec, {{.force = data, .markers = {}}}, made_up_sensor());
}

/// A check that multiplies the force by exp(a + b depth).
CheckedPress check_of(const std::string& name, double a, double b) {
  CheckedPress check{
      .check = name, .measurement = 0, .table = {.x = {}, .y = Eigen::MatrixXd::Zero(2, 21), .exponent = 0.5}};
  for (int i = 0; i <= 20; ++i) {
    const double x = 0.1 * i;
    check.table.x.push_back(x);
    check.table.y(0, i) = 1e-5 * x * x;
    check.table.y(1, i) = check.table.y(0, i) * std::exp(a + b * x);
  }
  return check;
}

TEST(ModulusError, IsTheChangeOfTheForceAsTheFitWeighsItsRows) {
  // Equal relative deviations weigh alike: ln changes by 0.1 + 0.2 · 0.75.
  EXPECT_NEAR(modulus_error({check_of("a", 0.1, 0.2)}, model_with(0.005, 0.02)).at("a"), 0.25, 1e-3);
  // The deep row alone counts where the shallow one is uncertain.
  EXPECT_NEAR(modulus_error({check_of("a", 0.1, 0.2)}, model_with(5.0, 0.02)).at("a"), 0.3, 1e-3);
}

TEST(ModelError, LeavesOutWhatTheModulusTakesAndAddsChecksAsSquares) {
  const MechanicsModel model = model_with(0.005, 0.02);
  EXPECT_NEAR(model_error({check_of("a", 0.3, 0.0)}, model, 0, 1.5), 0.0, 1e-6);
  // 0.2 · (1.5 − 0.75), and −0.1 of the same.
  EXPECT_NEAR(model_error({check_of("a", 0.1, 0.2), check_of("b", 0.0, -0.1)}, model, 0, 1.5), std::hypot(0.15, 0.075),
              1e-3);
}

TEST(PredictForces, HasEveryRowOnceAndJudgesThoseThatWereNotFitted) {
  MechanicsModel model = model_with(0.005, 0.02);
  const Fit fit = fit_mechanics(model);
  const auto rows = predict_forces(model, draw_posterior(model, fit, 1000, 1), {check_of("a", 0.0, 0.1)});
  ASSERT_EQ(rows.size(), 4U);
  const std::vector<double> depths{0.5, 1.0, 1.2, 1.5};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i].depth_mm, depths[i]);
    EXPECT_EQ(rows[i].fitted, i < 2);
    EXPECT_NEAR(rows[i].force_n, 2.0 * depths[i] * depths[i], 0.02 * rows[i].force_n);
    EXPECT_LT(rows[i].low_n, rows[i].force_n);
    EXPECT_GT(rows[i].high_n, rows[i].force_n);
  }
  EXPECT_TRUE(rows[2].covered());
  EXPECT_FALSE(rows[3].measured_n);
  EXPECT_GT((rows[3].high_n - rows[3].low_n) / rows[3].force_n, (rows[1].high_n - rows[1].low_n) / rows[1].force_n);
}

}  // namespace predictions_test
}  // namespace tacipc
