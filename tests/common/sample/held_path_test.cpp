// Creep is told from slip by how fast an object moves and how much of the contact slips, not by how far it gets.
#include "common/sample/held_path.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace tacipc {
namespace held_path_test {

constexpr double kSlow_m_s = 40e-6, kStep_s = 0.01;

Matrix4 pose_at(const Vector3& at_m, const Vector3& turn_rad = Vector3::Zero()) {
  Matrix4 pose = Matrix4::Identity();
  if (const double angle = turn_rad.norm(); angle > 0.0)
    pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(angle, turn_rad / angle).toRotationMatrix();
  pose.topRightCorner<3, 1>() = at_m;
  return pose;
}

/// At this speed for so many frames, from where it was freed.
HeldPath path_at(double speed_m_s, double slip_share, int frames) {
  HeldPath path(pose_at({1e-3, 0, 0}), Vector3::Zero(), kSlow_m_s);
  for (int f = 1; f <= frames; ++f)
    path.go_on(pose_at({1e-3, 0, -speed_m_s * kStep_s * f}),
               {.seconds = kStep_s, .slip_share = slip_share, .radius_m = 5e-3});
  return path;
}

TEST(HeldPath, HoweverFarItCreepsItDoesNotSlip) {
  const HeldPath path = path_at(0.9 * kSlow_m_s, 0.3, 5000);  // 50 s
  EXPECT_NEAR(path.way_m(), 1.8e-3, 1e-12);
  EXPECT_NEAR(path.creep_m(), 1.8e-3, 1e-12);
  EXPECT_NEAR(path.slip_m(), 0.0, 1e-12);
}

TEST(HeldPath, WhatIsFasterOrSlipsAsAWholeSlips) {
  for (const HeldPath& path : {path_at(1.1 * kSlow_m_s, 0.3, 5000), path_at(0.9 * kSlow_m_s, 0.95, 5000)}) {
    EXPECT_EQ(path.creep_m(), 0.0);
    EXPECT_EQ(path.slip_m(), path.way_m());
    EXPECT_GT(path.slip_m(), 1.5e-3);
  }
}

TEST(HeldPath, AStretchOfSlipIsKeptApartFromTheCreepAroundIt) {
  HeldPath path(pose_at({0, 0, 0}), {0, 0, 2e-3}, kSlow_m_s);
  double down_m = 0.0;
  for (int f = 1; f <= 300; ++f) {
    const bool slips = f > 100 && f <= 110;
    down_m += slips ? 0.1e-3 : 0.3e-6;
    path.go_on(pose_at({0, 0, -down_m}), {.seconds = kStep_s, .slip_share = slips ? 1.0 : 0.2, .radius_m = 5e-3});
  }
  EXPECT_NEAR(path.creep_m(), 290 * 0.3e-6, 1e-12);
  EXPECT_NEAR(path.slip_m(), 1e-3, 1e-12);
  EXPECT_NEAR(path.way_m(), 1e-3 + 290 * 0.3e-6, 1e-12);
}

TEST(HeldPath, ATurnCreepsWhereItsRimIsSlow) {
  const auto turn = [](double rad_s, double radius_m) {
    HeldPath path(pose_at({0, 0, 0}), Vector3::Zero(), kSlow_m_s);
    for (int f = 1; f <= 2000; ++f)
      path.go_on(pose_at({0, 0, 0}, {rad_s * kStep_s * f, 0, 0}),
                 {.seconds = kStep_s, .slip_share = 0.5, .radius_m = radius_m});
    return path;
  };
  const HeldPath creeps = turn(7e-3, 5e-3), slips = turn(7e-3, 6e-3);
  EXPECT_NEAR(creeps.creep_rad(), 0.14, 1e-9);
  EXPECT_NEAR(creeps.slip_rad(), 0.0, 1e-7);
  EXPECT_NEAR(creeps.turn_rad(), 0.14, 1e-9);
  EXPECT_EQ(slips.creep_rad(), 0.0);
  EXPECT_NEAR(slips.slip_rad(), 0.14, 1e-9);
}

}  // namespace held_path_test
}  // namespace tacipc
