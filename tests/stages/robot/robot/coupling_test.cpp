// What a robot feels between two answers of a press.
#include "stages/robot/robot/coupling.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tacipc {
namespace coupling_test {

constexpr double kStiffness_n_m = 5000.0;

/// A gel with its origin at `at` that looks along z.
PadAnswer answer_at(const Vector3& at, const Vector3& force_n, double gap_m = 0.0) {
  PadAnswer answer{.wrench = {force_n, Vector3::Zero()}, .gap_m = gap_m};
  answer.world_from_gel.topRightCorner<3, 1>() = at;
  return answer;
}

TEST(FeltWrench, IsTheAnswerWhereItWasGiven) {
  PadAnswer answer{.wrench = {{0.1, -0.2, -3.0}, {0.01, 0.0, 0.02}}};
  const Wrench felt = felt_wrench(answer, Vector3::Zero(), kStiffness_n_m);
  EXPECT_EQ(felt.force_n, answer.wrench.force_n);
  EXPECT_EQ(felt.torque_n_m, answer.wrench.torque_n_m);
}

TEST(FeltWrench, GrowsByTheSpringOnTheWayInAndByHalfOfItAcross) {
  PadAnswer answer = answer_at({1.0, 2.0, 3.0}, {0.1, 0.0, -3.0});
  answer.wrench.torque_n_m = {0.0, 0.5, 0.0};
  const Wrench felt = felt_wrench(answer, Vector3(1.0 + 1e-4, 2.0 - 2e-4, 3.0 + 3e-4), kStiffness_n_m);
  EXPECT_LT((felt.force_n - Vector3(0.1 - 0.25, 0.5, -3.0 - 1.5)).norm(), 1e-9);
  EXPECT_EQ(felt.torque_n_m, answer.wrench.torque_n_m);
}

TEST(FeltWrench, TurnsWithTheGel) {
  PadAnswer answer = answer_at({0.0, 0.0, 0.0}, {-2.0, 0.0, 0.0});
  // Its z is x of the world.
  answer.world_from_gel.topLeftCorner<3, 3>() << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  const Wrench felt = felt_wrench(answer, Vector3(1e-4, 0.0, 2e-4), kStiffness_n_m);
  EXPECT_LT((felt.force_n - Vector3(-2.5, 0.0, -0.5)).norm(), 1e-12);
}

TEST(FeltWrench, NeverPulls) {
  const PadAnswer pressed = answer_at(Vector3::Zero(), {0.4, 0.0, -1.0});
  EXPECT_LT((felt_wrench(pressed, Vector3(0, 0, -1e-4), kStiffness_n_m).force_n - Vector3(0.4, 0.0, -0.5)).norm(),
            1e-12);
  const Wrench away = felt_wrench(pressed, Vector3(0, 0, -3e-4), kStiffness_n_m);
  EXPECT_EQ(away.force_n, Vector3::Zero());
  EXPECT_EQ(away.torque_n_m, Vector3::Zero());
}

TEST(FeltWrench, BeginsBehindTheGapWhereNothingWasPressed) {
  const PadAnswer free = answer_at(Vector3::Zero(), Vector3::Zero(), 2e-4);
  EXPECT_EQ(felt_wrench(free, Vector3(0, 0, 1e-4), kStiffness_n_m).force_n, Vector3::Zero());
  // No friction in what has not touched yet.
  const Wrench beyond = felt_wrench(free, Vector3(1e-3, 0, 5e-4), kStiffness_n_m);
  EXPECT_LT((beyond.force_n - Vector3(0, 0, -1.5)).norm(), 1e-12);
  EXPECT_EQ(beyond.torque_n_m, Vector3::Zero());
}

/// Two gels that hold an object between them: at −10 mm looking along z, at 10 mm looking back.
std::vector<PadAnswer> holding(int carried) {
  std::vector<PadAnswer> both{answer_at({0, 0, -0.01}, {0, 0, -2.0}), answer_at({0, 0, 0.01}, {0, 0, 2.0})};
  both[1].world_from_gel.topLeftCorner<3, 3>() = Vector3(1.0, -1.0, -1.0).asDiagonal();
  for (PadAnswer& pad : both) pad.carried = carried;
  return both;
}
const std::vector<double> kStiffnesses{kStiffness_n_m, 3.0 * kStiffness_n_m};

const std::vector<Vector3> kStays{Vector3::Zero()};

TEST(FeltWrenches, AnObjectThatDoesNotGiveWayMakesThemOneByOne) {
  const auto answers = holding(-1);
  const std::vector<Vector3> origins{{0, 0, -0.0099}, {0, 0, 0.01}};
  const auto felt = felt_wrenches(answers, origins, kStiffnesses, {}, {}).wrenches;
  for (std::size_t p = 0; p < 2; ++p)
    EXPECT_EQ(felt[p].force_n, felt_wrench(answers[p], origins[p], kStiffnesses[p]).force_n);
}

TEST(FeltWrenches, AlmostWithoutMassAnObjectGoesWhereItsSpringsPushEqually) {
  const std::vector<Vector3> origins{{0, 0, -0.0099}, {0, 0, 0.01}};
  const auto felt = felt_wrenches(holding(0), origins, kStiffnesses, std::vector{1e-9}, kStays).wrenches;
  // In series: 1 / (1/K + 1/3K) = 3/4 K, on a way of 0.1 mm.
  const double both = 2.0 + 0.75 * kStiffness_n_m * 1e-4;
  EXPECT_NEAR(felt[0].force_n.z(), -both, 1e-9);
  EXPECT_NEAR(felt[1].force_n.z(), both, 1e-9);
}

TEST(FeltWrenches, MovedTogetherTheyPushTheMassAlone) {
  const double inertia = 200.0;  // m/h²
  const Vector3 way(2e-5, 0.0, 1e-4);
  const std::vector<Vector3> origins{Vector3(0, 0, -0.01) + way, Vector3(0, 0, 0.01) + way};
  const auto felt = felt_wrenches(holding(0), origins, kStiffnesses, std::vector{inertia}, kStays).wrenches;
  const Vector3 sum = felt[0].force_n + felt[1].force_n;
  // In series with the mass: u = K/(K + m/h²) way, and what the gels feel is −m/h² u.
  const double along = 4.0 * kStiffness_n_m, across = 0.5 * along;
  EXPECT_NEAR(sum.z(), -inertia * along / (along + inertia) * way.z(), 1e-9);
  EXPECT_NEAR(sum.x(), -inertia * across / (across + inertia) * way.x(), 1e-9);
}

TEST(FeltWrenches, OneThatIsNotPressedYetMeetsTheObjectThatTheOtherMoves) {
  // The object is light, so it goes along with the first pad; the second waits 0.1 mm behind it, stiff.
  std::vector<PadAnswer> answers = holding(0);
  answers[1].wrench.force_n.setZero();
  answers[1].gap_m = 1e-4;
  const double inertia = 100.0, way = 5e-4;
  const std::vector<Vector3> origins{{0, 0, -0.01 + way}, {0, 0, 0.01}};
  const FeltWrenches felt = felt_wrenches(answers, origins, kStiffnesses, std::vector{inertia}, kStays);
  // K (way − u) = m/h² u + 3 K (u − gap), the force that it began with being the object's own business.
  const double K = kStiffness_n_m, u = (K * way + 3.0 * K * 1e-4) / (inertia + 4.0 * K);
  ASSERT_GT(u, 1e-4);
  EXPECT_LT((felt.along_m[0] - Vector3(0, 0, u)).norm(), 1e-12);
  EXPECT_NEAR(felt.wrenches[0].force_n.z(), -2.0 - K * (way - u), 1e-9);
  EXPECT_NEAR(felt.wrenches[1].force_n.z(), 3.0 * K * (u - 1e-4), 1e-9);
}

TEST(FeltWrenches, OneThatLosesTheObjectLetsTheOtherPushIt) {
  // The second pad goes away by 1 mm; then the first alone pushes, with 2 N at the start.
  const double inertia = 3000.0;
  const std::vector<Vector3> origins{{0, 0, -0.01}, {0, 0, 0.011}};
  const FeltWrenches felt = felt_wrenches(holding(0), origins, kStiffnesses, std::vector{inertia}, kStays);
  EXPECT_EQ(felt.wrenches[1].force_n, Vector3::Zero());
  const double u = 2.0 / (inertia + kStiffness_n_m);
  EXPECT_NEAR(felt.along_m[0].z(), u, 1e-12);
  EXPECT_NEAR(felt.wrenches[0].force_n.z(), -2.0 + kStiffness_n_m * u, 1e-9);
}

TEST(FeltWrenches, AnObjectGoesOnAsItIsExpectedTo) {
  const Vector3 expected(1e-5, 0.0, 2e-4);
  const std::vector<Vector3> origins{{0, 0, -0.01}, {0, 0, 0.01}};
  // Of a heavy one nothing but that.
  const FeltWrenches heavy = felt_wrenches(holding(0), origins, kStiffnesses, std::vector{1e12}, std::vector{expected});
  EXPECT_LT((heavy.along_m[0] - expected).norm(), 1e-10);
  EXPECT_NEAR(heavy.wrenches[1].force_n.z(), 2.0 + 3.0 * kStiffness_n_m * 2e-4, 1e-4);
  // Pads that go with it feel what they answered.
  const std::vector<Vector3> along{origins[0] + expected, origins[1] + expected};
  const FeltWrenches same = felt_wrenches(holding(0), along, kStiffnesses, std::vector{50.0}, std::vector{expected});
  EXPECT_LT((same.wrenches[0].force_n - Vector3(0, 0, -2)).norm(), 1e-9);
}

TEST(LearntStiffness, IsThatOfTheDeepestPad) {
  std::vector<PadAnswer> pads{answer_at({0, 0, 0}, {0, 0, -1.0}, -1e-4), answer_at({0, 0, 0}, {0, 0, -6.0}, -3e-4),
                              answer_at({0, 0, 0}, Vector3::Zero(), -9e-4), answer_at({0, 0, 0}, {0, 0, -2.0}, 1e-4)};
  EXPECT_NEAR(learnt_stiffness(pads).value(), 2e4, 1e-6);
  pads.erase(pads.begin(), pads.begin() + 2);
  EXPECT_FALSE(learnt_stiffness(pads).has_value());
}

TEST(SecantStiffness, IsForceOverWay) {
  const PadAnswer earlier = answer_at({0, 0, 0}, {0, 0, -1.0}), later = answer_at({1.0, 0, 1e-4}, {0.3, 0, -1.6});
  EXPECT_NEAR(secant_stiffness(earlier, later, 5000.0), 6000.0, 1e-6);
  EXPECT_NEAR(secant_stiffness(later, earlier, 5000.0), 6000.0, 1e-6);
}

TEST(SecantStiffness, StaysNearWhatIsKnownOtherwise) {
  const PadAnswer earlier = answer_at({0, 0, 0}, {0, 0, -1.0}), later = answer_at({0, 0, 1e-4}, {0, 0, -1.6});
  EXPECT_EQ(secant_stiffness(earlier, later, 1000.0), 5000.0);
  EXPECT_EQ(secant_stiffness(earlier, later, 60000.0), 12000.0);
  // The force fell on the way in.
  EXPECT_EQ(secant_stiffness(answer_at({0, 0, 0}, {0, 0, -2.0}), later, 5000.0), 1000.0);
  PadAnswer sliding = later;
  sliding.may_slide = true;
  EXPECT_EQ(secant_stiffness(answer_at({0, 0, 0}, {0, 0, -2.0}), sliding, 5000.0), 50.0);
  EXPECT_EQ(secant_stiffness(answer_at({0, 0, 0}, Vector3::Zero()), later, 777.0), 777.0);
  EXPECT_EQ(secant_stiffness(earlier, answer_at({0, 0, 1e-8}, {0, 0, -1.6}), 777.0), 777.0);
}

TEST(InterfaceResidual, IsTheWorstOfForceAndTorque) {
  const std::vector<Wrench> felt{{{1, 0, 0}, Vector3::Zero()}, {{0, 0, -4}, {0, 0.01, 0}}};
  std::vector<Wrench> answer = felt;
  EXPECT_EQ(interface_residual(felt, answer, 0.02).relative, 0.0);
  answer[0].force_n = {1, 0.3, 0.4};
  EXPECT_NEAR(interface_residual(felt, answer, 0.02).wrench_n, 0.5, 1e-12);
  EXPECT_NEAR(interface_residual(felt, answer, 0.02).relative, 0.125, 1e-12);
  answer[1].torque_n_m = {0, 0.017, 0};  // 7 mN m at 10 mm
  EXPECT_NEAR(interface_residual(felt, answer, 0.02).wrench_n, 0.7, 1e-12);
  EXPECT_NEAR(interface_residual(felt, answer, 10.0).relative, 0.07, 1e-12);
}

Eigen::VectorXd vector(std::initializer_list<double> values) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.data());
  return v;
}

TEST(BalancedForces, OfALinearRobotAreThoseOfItsEquations) {
  // x = x₀ + C f, f = f₀ − K x; all coupled with each other.
  Eigen::Matrix3d C, K;
  C << 2e-4, 3e-5, 0.0, 3e-5, 1e-4, -2e-5, 0.0, -2e-5, 3e-4;
  K << 2e4, 0.0, 1e3, 0.0, 7e4, 0.0, 1e3, 0.0, 5e3;
  const Eigen::Vector3d x0(1e-3, -2e-3, 5e-4), f0(-1.0, 2.0, 0.5);
  const Eigen::Vector3d exact = Eigen::MatrixXd(Eigen::Matrix3d::Identity() + K * C).partialPivLu().solve(f0 - K * x0);
  int ends = 0;
  const Eigen::VectorXd force =
      balanced_forces([&](const Eigen::VectorXd& f) { return ++ends, Eigen::VectorXd(x0 + C * f); },
                      [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(f0 - K * x); }, vector({0.0, 0.0, 0.0}));
  EXPECT_LT((force - exact).norm(), 1e-6 * exact.norm());
  // As many as there are numbers, where it was, and where it is.
  EXPECT_LE(ends, 6);
}

/// A mass that comes to x₀ without force, and a wall that pushes back from x = 0 on.
double against_a_wall(double x0, double compliance, double stiffness, double begin) {
  return balanced_forces([&](const Eigen::VectorXd& f) { return vector({x0 + compliance * f[0]}); },
                         [&](const Eigen::VectorXd& x) { return vector({-stiffness * std::max(0.0, x[0])}); },
                         vector({begin}))[0];
}

TEST(BalancedForces, OfAWallAreThereInContactAndNotWithoutIt) {
  for (const double begin : {0.0, -5.0, -0.1}) {
    for (const double compliance : {1e-6, 1e-4, 1e-2}) {
      EXPECT_NEAR(against_a_wall(1e-3, compliance, 7e4, begin), -7e4 * 1e-3 / (1.0 + 7e4 * compliance), 1e-5);
      EXPECT_NEAR(against_a_wall(-1e-3, compliance, 7e4, begin), 0.0, 1e-8);
    }
  }
}

TEST(BalancedForces, OfARobotThatGivesWayDifferentlyFromALimitOnAreMet) {
  // A drive that holds with 1/5e4 m/N up to 2 N, and beyond that only by the mass behind it, 1/500 m/N.
  for (const double ahead : {2e-5, 1e-4, 1e-3, 5e-3}) {
    const auto end = [&](const Eigen::VectorXd& f) {
      const double held = std::clamp(f[0], -2.0, 2.0);
      return vector({ahead + held / 5e4 + (f[0] - held) / 500.0});
    };
    const auto law = [](const Eigen::VectorXd& x) { return vector({-3e4 * std::max(0.0, x[0])}); };
    const Eigen::VectorXd force = balanced_forces(end, law, vector({0.0}));
    EXPECT_LT((law(end(force)) - force).norm(), 1e-5 * force.norm()) << ahead;
  }
}

TEST(BalancedForces, OfTwoPadsOfWhichOneLosesContactAreMet) {
  // Pads that stand on one plate: what pushes one up lets the other down.
  const auto end = [](const Eigen::VectorXd& f) {
    return vector({1e-4 + 2e-4 * f[0] - 1.5e-4 * f[1], -2e-4 - 1.5e-4 * f[0] + 2e-4 * f[1]});
  };
  const auto law = [](const Eigen::VectorXd& x) {
    return vector({-2e4 * std::max(0.0, x[0]), -2e4 * std::max(0.0, x[1])});
  };
  const Eigen::VectorXd force = balanced_forces(end, law, vector({-3.0, -3.0}));
  const Eigen::VectorXd answered = law(end(force));
  // The second stands free: 2e4 (1e-4 + 2e-4 f) = −f.
  EXPECT_NEAR(force[0], -0.4, 1e-6);
  EXPECT_EQ(force[1], 0.0);
  for (const Eigen::Index k : {0, 1}) EXPECT_NEAR(answered[k], force[k], 1e-6);
}

}  // namespace coupling_test
}  // namespace tacipc
