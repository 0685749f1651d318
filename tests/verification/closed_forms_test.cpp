// Closed forms against each other and against values by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.h"
#include "verification/closed_forms.h"

namespace tacipc::verify {
namespace closed_forms_test {

const Elastic kGel{1.2e5, 0.43};

TEST(ClosedForms, HertzByHand) {
  const Indentation found = hertz({1e5, 0.5}, 0.004, 0.0001);
  EXPECT_NEAR(found.force_n, 4.0 / 3.0 * 1e5 / 0.75 * std::sqrt(0.004) * 1e-6, 1e-12);
  EXPECT_NEAR(found.contact_radius_m, std::sqrt(4e-7), 1e-15);
}

TEST(ClosedForms, SneddonsSphereBecomesHertzAtSmallDepth) {
  // δ = a artanh(a/R) and F expand to Hertz times 1 − (δ/R)/10 + …
  for (const double relative : {1e-2, 1e-3}) {
    const double ratio = sneddon_sphere(kGel, 1.0, relative).force_n / hertz(kGel, 1.0, relative).force_n;
    EXPECT_NEAR((1.0 - ratio) / relative, 0.1, 0.01) << relative;
  }
}

TEST(ClosedForms, CompressionHasFreeSidesForBothLaws) {
  for (const double s : {0.6, 0.95, 1.2}) {
    const double mu = kGel.shear_modulus_pa(), lambda = kGel.lame_lambda_pa();
    const Compression neo = uniform_compression("neo_hookean", kGel, s);
    const double t = neo.lateral_stretch, log_j = std::log(s * t * t);
    EXPECT_NEAR(mu * t - (mu - lambda * log_j) / t, 0.0, 1e-9 * mu);
    EXPECT_EQ(neo.nominal_stress_pa < 0.0, s < 1.0);
    // The energy along the equilibrium path must grow by the work of P_zz.
    const auto energy = [&](double stretch) {
      const double side = uniform_compression("neo_hookean", kGel, stretch).lateral_stretch;
      const double l = std::log(stretch * side * side);
      return mu / 2 * (stretch * stretch + 2 * side * side - 3) - mu * l + lambda / 2 * l * l;
    };
    EXPECT_NEAR((energy(s + 1e-5) - energy(s - 1e-5)) / 2e-5, neo.nominal_stress_pa, 1e-6 * mu);
    const Compression hencky = uniform_compression("stvk_hencky", kGel, s);
    const double axial = std::log(s), side = std::log(hencky.lateral_stretch);
    EXPECT_NEAR(2 * mu * side + lambda * (axial + 2 * side), 0.0, 1e-9 * mu);
    EXPECT_NEAR(hencky.nominal_stress_pa * s, 2 * mu * axial + lambda * (axial + 2 * side), 1e-9 * mu);
  }
  try {
    uniform_compression("rubber", kGel, 0.9);
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "no closed form of uniform compression for the material law 'rubber'");
  }
}

TEST(ClosedForms, CompressionIsHookesLawAtSmallStrain) {
  for (const char* law : {"neo_hookean", "stvk_hencky"}) {
    const Compression found = uniform_compression(law, kGel, 1.0 - 1e-6);
    EXPECT_NEAR(found.nominal_stress_pa / (-1e-6 * kGel.youngs_modulus_pa), 1.0, 1e-5) << law;
    EXPECT_NEAR((found.lateral_stretch - 1.0) / 1e-6, kGel.poissons_ratio, 1e-5) << law;
  }
}

TEST(ClosedForms, ARelaxingForceBeginsAtTheInstantaneousModulusAndEndsAtTheLongTermOne) {
  const std::vector<Relaxation> series{{0.3, 1.0}, {0.2, 0.1}};
  EXPECT_NEAR(relaxing_force_factor(series, 1e-9, 0.0), 1.0 / 0.5, 1e-7);
  EXPECT_NEAR(relaxing_force_factor(series, 1e-9, 0.1), (0.5 + 0.3 * std::exp(-0.1) + 0.2 / std::exp(1.0)) / 0.5, 1e-7);
  EXPECT_NEAR(relaxing_force_factor(series, 0.1, 50.0), 1.0, 1e-12);
  // A ramp of two halves is the mean of them, each half the strain at its own time.
  const double halves = relaxing_force_factor(series, 0.5, 0.7) + relaxing_force_factor(series, 0.5, 1.2);
  EXPECT_NEAR(relaxing_force_factor(series, 1.0, 0.7), 0.5 * halves, 1e-12);
}

}  // namespace closed_forms_test
}  // namespace tacipc::verify
