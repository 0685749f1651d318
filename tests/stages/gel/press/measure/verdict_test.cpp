#include "stages/gel/press/measure/verdict.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tacipc {
namespace verdict_test {

const SolverLimits kLimits{.velocity_residual_m_s = 3e-5, .force_residual_n = 2e-4, .friction_residual_n = 4e-4};

FrameNumbers good() { return {.min_gap_m = 2e-6, .min_volume_ratio = 0.7}; }

/// Everything at the very limit it may reach.
FrameNumbers barely_good() {
  return {.min_gap_m = 1e-300,
          .min_volume_ratio = 1e-300,
          .velocity_residual_m_s = 3e-5,
          .force_residual_n = 2e-4,
          .friction_residual_n = 4e-4,
          .balance_relative = 1e-3,
          .pose_error_m = 1e-9,
          .body_strain = 1e-3,
          .body_balance_relative = 1e-3,
          .body_torque_relative = 1e-3};
}

struct Told {
  Miss miss;
  std::string message;
};

Told judged(const FrameNumbers& numbers, const SolverLimits& limits = kLimits) {
  try {
    judge_frame(7, numbers, limits);
  } catch (const VerdictError& error) {
    return {error.miss(), error.what()};
  }
  return {};
}

void expect_miss(const Told& told, const char* check, double value, double limit, const char* message) {
  EXPECT_EQ(told.miss.frame, 7);
  EXPECT_EQ(told.miss.check, check);
  EXPECT_DOUBLE_EQ(told.miss.value, value);
  EXPECT_DOUBLE_EQ(told.miss.limit, limit);
  EXPECT_EQ(told.message, message);
}

TEST(Verdict, FramesWithinTheirLimitsPass) {
  EXPECT_NO_THROW(judge_frame(0, good(), kLimits));
  EXPECT_NO_THROW(judge_frame(1, barely_good(), kLimits));
}

TEST(Verdict, Intersections) {
  auto numbers = good();
  numbers.intersections = 3;
  expect_miss(judged(numbers), "intersections", 3, 0, "frame 7: 3 pairs of triangles intersect");
}

TEST(Verdict, Containment) {
  auto numbers = good();
  for (const double rounded : {-1e-9, 1e-9}) {
    numbers.gel_in_object = rounded;
    EXPECT_EQ(judged(numbers).message, "");
  }
  numbers.gel_in_object = 1.0;
  expect_miss(judged(numbers), "containment", 1.0, 0.5,
              "frame 7: the gel is inside the object (its surface winds 1 times around it)");
}

TEST(Verdict, InvertedTets) {
  auto numbers = good();
  numbers.inverted_tets = 1;
  expect_miss(judged(numbers), "inverted_tets", 1, 0, "frame 7: 1 tetrahedra are inverted");
}

TEST(Verdict, SmallestDistance) {
  auto numbers = good();
  numbers.min_gap_m = 0.0;
  expect_miss(judged(numbers), "smallest_distance", 0, 0, "frame 7: smallest distance 0 m does not exceed 0");
}

TEST(Verdict, VolumeRatio) {
  auto numbers = good();
  numbers.min_volume_ratio = -0.0125;
  expect_miss(judged(numbers), "volume_ratio", -0.0125, 0, "frame 7: smallest volume ratio -0.0125 does not exceed 0");
}

TEST(Verdict, VelocityResidual) {
  auto numbers = good();
  numbers.velocity_residual_m_s = 3.1e-5;
  expect_miss(judged(numbers), "velocity_residual", 3.1e-5, 3e-5,
              "frame 7: velocity residual 3.1e-05 m/s exceeds 3e-05 m/s");
}

TEST(Verdict, ForceResidual) {
  auto numbers = good();
  numbers.force_residual_n = 2.5e-4;
  expect_miss(judged(numbers), "force_residual", 2.5e-4, 2e-4, "frame 7: force residual 0.00025 N exceeds 0.0002 N");
}

TEST(Verdict, FrictionResidualOnlyWhereOneWasPromised) {
  auto numbers = good();
  numbers.friction_residual_n = 0.01;
  expect_miss(judged(numbers), "friction_residual", 0.01, 4e-4, "frame 7: friction residual 0.01 N exceeds 0.0004 N");
  auto once = kLimits;
  once.friction_residual_n.reset();
  EXPECT_EQ(judged(numbers, once).message, "");
}

TEST(Verdict, Balance) {
  auto numbers = good();
  numbers.balance_n = 0.0042;
  numbers.balance_relative = 0.0021;
  expect_miss(judged(numbers), "balance", 0.0021, 1e-3,
              "frame 7: forces do not balance: residual 0.0042 N, 0.0021 of the contact force (limit 0.001)");
}

TEST(Verdict, PoseError) {
  auto numbers = good();
  numbers.pose_error_m = 1.5e-9;
  expect_miss(judged(numbers), "pose_error", 1.5e-9, 1e-9, "frame 7: pose error 1.5e-09 m exceeds 1e-09 m");
}

TEST(Verdict, FreeObject) {
  auto numbers = good();
  numbers.body_strain = 2e-3;
  expect_miss(judged(numbers), "body_strain", 2e-3, 1e-3, "frame 7: strain of the free object 0.002 exceeds 0.001");
  numbers = good();
  numbers.body_balance_relative = 4e-3;
  expect_miss(judged(numbers), "body_balance", 4e-3, 1e-3,
              "frame 7: part of the free object's load that is not balanced, 0.004 exceeds 0.001");
  numbers = good();
  numbers.body_torque_relative = 5e-3;
  expect_miss(judged(numbers), "body_torque", 5e-3, 1e-3,
              "frame 7: torque on the free object that is not balanced, as a fraction of its load on 10 mm, 0.005 "
              "exceeds 0.001");
}

TEST(Verdict, DrivesOfAGrasp) {
  EXPECT_NO_THROW(judge_grip(4, 0.02));
  const auto miss = [](double imbalance) {
    try {
      judge_grip(4, imbalance);
    } catch (const VerdictError& error) {
      EXPECT_EQ(error.miss().check, "grip_balance");
      EXPECT_EQ(error.miss().frame, 4);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(
      miss(0.35),
      "frame 4: 0.35 of the force is missing to the balance of a finger's drive (limit 0.02): give the phase more "
      "substeps, or the drive damping");
  EXPECT_NE(miss(std::numeric_limits<double>::quiet_NaN()), "");
}

TEST(Verdict, APressThatTouchesNothing) {
  try {
    fail_untouched(5, {12e-3, 0.5e-3, -0.25e-3}, {-10e-3, -8e-3}, {10e-3, 8e-3});
    ADD_FAILURE();
  } catch (const VerdictError& error) {
    EXPECT_EQ(error.miss().check, "contact");
    EXPECT_EQ(error.miss().frame, 5);
    EXPECT_STREQ(error.what(),
                 "frame 5: nothing has touched the gel: the object's lowest point went 0.25 mm below the undeformed "
                 "front at x 12 mm, y 0.5 mm, but the front reaches from -10 to 10 mm and from -8 to 8 mm. Place it "
                 "with placement.center_mm, or say placement.may_miss: true");
  }
}

TEST(Verdict, WhatIsNoNumberMissesItsLimit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<double FrameNumbers::*, const char*> members[] = {
      {&FrameNumbers::gel_in_object, "containment"},
      {&FrameNumbers::min_volume_ratio, "volume_ratio"},
      {&FrameNumbers::velocity_residual_m_s, "velocity_residual"},
      {&FrameNumbers::force_residual_n, "force_residual"},
      {&FrameNumbers::friction_residual_n, "friction_residual"},
      {&FrameNumbers::balance_relative, "balance"},
      {&FrameNumbers::pose_error_m, "pose_error"},
      {&FrameNumbers::body_strain, "body_strain"},
      {&FrameNumbers::body_balance_relative, "body_balance"},
      {&FrameNumbers::body_torque_relative, "body_torque"}};
  for (const auto& [member, check] : members) {
    auto numbers = good();
    numbers.*member = nan;
    EXPECT_EQ(judged(numbers).miss.check, check);
    EXPECT_TRUE(std::isnan(judged(numbers).miss.value)) << check;
  }
  auto numbers = good();
  numbers.min_gap_m = nan;
  EXPECT_EQ(judged(numbers).miss.check, "smallest_distance");
  numbers.min_gap_m.reset();  // nothing is near
  EXPECT_EQ(judged(numbers).message, "");
}

TEST(Verdict, TheFirstMissIsTold) {
  FrameNumbers numbers{.min_gap_m = 0.0};  // as is the volume ratio
  numbers.balance_relative = 1.0;
  EXPECT_EQ(judged(numbers).miss.check, "smallest_distance");
  numbers.intersections = 1;
  EXPECT_EQ(judged(numbers).miss.check, "intersections");
}

}  // namespace verdict_test
}  // namespace tacipc
