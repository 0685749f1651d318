#include "stages/study/identify/force_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tacipc {
namespace force_model_test {

/// N per Pa, over mm.
Curve force_per_pa(double exponent) {
  std::vector<double> x;
  Eigen::VectorXd y(41);
  for (int i = 0; i <= 40; ++i) {
    x.push_back(0.05 * i);
    y[i] = 1e-5 * std::pow(x.back(), exponent);
  }
  return {x, y, exponent < 1.5 ? 1.0 : kPressExponent};
}

TEST(PressedForce, IsThatOfTheDepthThatTheMountLeaves) {
  const Curve curve = force_per_pa(2.0);
  const double rigid = pressed_force_n(curve, {.modulus_pa = 2e5}, 1.0);
  EXPECT_NEAR(rigid, 2.0, 1e-3);
  const Mounting soft{.modulus_pa = 2e5, .compliance_mm_per_n = 0.05};
  const double force = pressed_force_n(curve, soft, 1.0);
  EXPECT_LT(force, 0.95 * rigid);
  EXPECT_NEAR(force, pressed_force_n(curve, {.modulus_pa = 2e5}, 1.0 - 0.05 * force), 1e-12);
  EXPECT_EQ(pressed_force_n(curve, soft, -0.1), 0.0);
}

TEST(ShearedForce, YieldsByTheComplianceAcross) {
  const Curve curve = force_per_pa(1.0);
  // A spring of 2 N/mm behind one of 10 N/mm.
  const Mounting soft{.modulus_pa = 2e5, .compliance_mm_per_n = 7.0, .shear_compliance_mm_per_n = 0.1};
  EXPECT_NEAR(sheared_force_n(curve, soft, 1.0), 1.0 / (0.5 + 0.1), 1e-9);
}

double closed_form(double t, double ramp, const std::vector<Relaxation>& terms, double per_mm) {
  double rest = 1.0, force = std::min(t / ramp, 1.0) * per_mm;
  for (const Relaxation& term : terms) rest -= term.part;
  for (const Relaxation& term : terms) {
    // ∫ over the ramp of g/g∞ e^{−(t−s)/τ} per_mm/ramp ds
    const double end = std::min(t, ramp);
    force += term.part / rest * per_mm / ramp * term.time_s *
             (std::exp((end - t) / term.time_s) - std::exp(-t / term.time_s));
  }
  return force;
}

TEST(RelaxingForce, IsTheClosedFormOfALinearSpring) {
  const std::vector<Relaxation> terms{{.part = 0.2, .time_s = 0.3}, {.part = 0.1, .time_s = 5.0}};
  const std::vector<double> times{0.0, 0.1, 0.5, 0.51, 1.0, 4.0, 30.0, 200.0};
  const auto forces = relaxing_force_n(force_per_pa(1.0), {.modulus_pa = 2e5}, terms, 1.0, 0.5, times);
  ASSERT_EQ(forces.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_NEAR(forces[i], closed_form(times[i], 0.5, terms, 2.0), 1e-9) << times[i];
  EXPECT_GT(forces[2], 1.2 * forces.back());
}

TEST(RelaxingForce, OfASpringBehindASoftMountIsThatOfTheSpringInTheEnd) {
  const std::vector<Relaxation> terms{{.part = 0.3, .time_s = 1.0}};
  const Mounting soft{.modulus_pa = 2e5, .compliance_mm_per_n = 0.1};
  const auto forces = relaxing_force_n(force_per_pa(1.0), soft, terms, 1.0, 0.01, {0.01, 60.0});
  EXPECT_NEAR(forces[1], 1.0 / (0.5 + 0.1), 1e-6);
  // At once the spring has 2 / 0.7 N/mm.
  EXPECT_NEAR(forces[0], 1.0 / (0.35 + 0.1), 0.01);
}

}  // namespace force_model_test
}  // namespace tacipc
