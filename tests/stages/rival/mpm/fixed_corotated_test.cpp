// The law against its closed forms, and sixteen at a time against one.
#include "stages/rival/mpm/fixed_corotated.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "common/base/rng.h"
#include "tests/stages/rival/mpm/kirchhoff_stress.h"

namespace tacipc {
namespace fixed_corotated_test {

constexpr double kMu = 2.0, kLambda = 3.0;

Matrix3 turn() { return Eigen::AngleAxisd(1.1, Vector3(1, 2, -2).normalized()).toRotationMatrix(); }
Matrix3 other_turn() { return Eigen::AngleAxisd(-0.7, Vector3(2, -1, 0.5).normalized()).toRotationMatrix(); }

/// 2 μ (s − 1) s + λ J (J − 1) along each principal direction.
Matrix3 closed_form(const Vector3& s) {
  const double J = s.prod();
  const Vector3 principal = 2.0 * kMu * (s.array() - 1.0) * s.array() + kLambda * J * (J - 1.0);
  return principal.asDiagonal();
}

TEST(KirchhoffStress, IsTheClosedFormOfPrincipalStretches) {
  for (const Vector3& s : {Vector3(1.2, 0.9, 0.7), Vector3(2.5, 1.0, 0.4), Vector3(1.3, 0.8, -0.2)}) {
    const Matrix3 F = turn() * s.asDiagonal() * other_turn().transpose();
    EXPECT_LT((kirchhoff_stress(F, kMu, kLambda) - turn() * closed_form(s) * turn().transpose()).norm(), 1e-13)
        << s.transpose();
  }
}

TEST(KirchhoffStress, OfARotationIsZero) { EXPECT_LT(kirchhoff_stress(turn(), kMu, kLambda).norm(), 1e-14); }

TEST(KirchhoffStress, SixteenAtATimeAreTheSame) {
  // Near rotations, strongly stretched, flattened to nothing and inverted.
  Matrix3 F[kParticleLanes];
  Lanes lanes[9], tau[9];
  for (int l = 0; l < kParticleLanes; ++l) {
    const auto seed = static_cast<std::uint64_t>(l);
    const Vector3 s(0.3 + 2.0 * random_uniform(1, 0, 3 * seed), 0.3 + 2.0 * random_uniform(1, 0, 3 * seed + 1),
                    l == 3       ? 0.0
                    : l % 5 == 4 ? -0.2
                                 : 0.3 + random_uniform(1, 0, 3 * seed + 2));
    const double angle = 6.0 * random_uniform(1, 1, seed);
    F[l] = Eigen::AngleAxisd(angle, Vector3(1, 1, 0.3).normalized()).toRotationMatrix() * s.asDiagonal() * turn();
    if (l == 7) F[l].setIdentity();
    for (int k = 0; k < 9; ++k) lanes[k][l] = static_cast<float>(F[l](k / 3, k % 3));
  }
  kirchhoff_stresses(lanes, static_cast<float>(kMu), static_cast<float>(kLambda), tau);
  for (int l = 0; l < kParticleLanes; ++l) {
    const Matrix3 expected = kirchhoff_stress(F[l], kMu, kLambda);
    for (int k = 0; k < 9; ++k)
      EXPECT_NEAR(tau[k][l], expected(k / 3, k % 3), 3e-6 * (1.0 + expected.norm())) << "lane " << l << " of " << k;
  }
  for (int k = 0; k < 9; ++k) EXPECT_EQ(tau[k][7], 0.0f) << "no stress without strain";
}

}  // namespace fixed_corotated_test
}  // namespace tacipc
