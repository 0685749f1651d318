#include "common/sample/scene_hold.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/scratch_folder.h"

namespace tacipc {
namespace scene_hold_test {

using ::testing::IsEmpty;

Matrix4 pose_at(const Vector3& at_m, const Vector3& turn_rad = Vector3::Zero()) {
  Matrix4 pose = Matrix4::Identity();
  if (const double angle = turn_rad.norm(); angle > 0.0)
    pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(angle, turn_rad / angle).toRotationMatrix();
  pose.topRightCorner<3, 1>() = at_m;
  return pose;
}

/// Two gels that face each other along x, 20 mm apart, a block between them and a table: both gels push with 2 N from
/// frame 1 on.
class SceneHoldTest : public ::testing::Test {
 protected:
  SceneHoldTest() {
    scene_.bodies = {"left", "right", "block", "table"};
    scene_.kinds = {"gel", "gel", "rigid", "fixed"};
    for (int f = 0; f < 4; ++f) {
      scene_.body_pose.push_back({left(0.0), right(0.0), pose_at({0, 0, 0}), pose_at({0, 0, -0.1})});
      scene_.per_frame.emplace_back(16, Wrench{Vector3::Zero(), Vector3::Zero()});
      if (f > 0) grip(f, 2.0);
    }
  }
  static Matrix4 left(double z) { return pose_at({-0.01, 0, z}, {0, std::numbers::pi / 2, 0}); }
  static Matrix4 right(double z) { return pose_at({0.01, 0, z}, {0, -std::numbers::pi / 2, 0}); }
  void grip(int frame, double force_n) {
    auto& wrenches = scene_.per_frame[static_cast<std::size_t>(frame)];
    wrenches[0 * 4 + 2].force_n = {-force_n, 0, 0};
    wrenches[1 * 4 + 2].force_n = {force_n, 0, 0};
  }
  void move(std::size_t frame, double hand_z, const Vector3& block_at, const Vector3& block_turn = Vector3::Zero()) {
    scene_.body_pose[frame] = {left(hand_z), right(hand_z), pose_at(block_at, block_turn), pose_at({0, 0, -0.1})};
  }
  std::vector<HeldBodyLines> held() const { return held_bodies(scene_, {0, 0, 0, 0}, {}); }

  SceneBodies scene_;
};

TEST_F(SceneHoldTest, AForceIntoAGelIsPositive) {
  EXPECT_NEAR(normal_force_n(left(0.0), {-2, 5, 7}), 2.0, 1e-15);
  EXPECT_NEAR(normal_force_n(right(0.0), {-2, 0, 0}), -2.0, 1e-15);
}

TEST_F(SceneHoldTest, ABodyThatRisesWithTheHandIsLifted) {
  move(3, 0.05, {0.0004, 0, 0.05});
  const auto bodies = held();
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0].body, "block");
  EXPECT_EQ(bodies[0].freed_frame, 1u);
  EXPECT_EQ(bodies[0].outcome, "lifted");
  EXPECT_NEAR(bodies[0].slip_m, 4e-4, 1e-15);
  EXPECT_NEAR(bodies[0].rise_m, 0.05, 1e-15);
  EXPECT_NEAR(bodies[0].hand_rise_m, 0.05, 1e-15);
}

TEST_F(SceneHoldTest, ABodyWhoseHandStaysIsHeld) {
  EXPECT_EQ(held()[0].outcome, "held");
  EXPECT_EQ(held()[0].slip_m, 0.0);
}

TEST_F(SceneHoldTest, ABodyThatLagsHasSlippedAndOneThatStaysBelowIsDropped) {
  move(3, 0.05, {0, 0, 0.0485});
  EXPECT_EQ(held()[0].outcome, "slipped");
  EXPECT_NEAR(held()[0].slip_m, 1.5e-3, 1e-15);
  move(3, 0.05, {0, 0, 0.009});
  EXPECT_EQ(held()[0].outcome, "dropped");
  move(3, 0.05, {0, 0, 0.05});
  grip(3, 0.9e-3);
  EXPECT_EQ(held()[0].outcome, "dropped");
}

TEST_F(SceneHoldTest, ABodyThatTurnsInTheHandIsRotated) {
  move(3, 0.05, {0, 0, 0.05}, {0.1, 0, 0});
  EXPECT_EQ(held()[0].outcome, "rotated");
  EXPECT_NEAR(held()[0].turn_rad, 0.1, 1e-12);
}

TEST_F(SceneHoldTest, MotionCountsFromTheFrameInWhichTheBodyIsFree) {
  move(1, 0.0, {0, 0, 0.01});
  const auto bodies = held_bodies(scene_, {0, 0, 2, 0}, {});
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0].freed_frame, 2u);
  EXPECT_EQ(bodies[0].slip_m, 0.0);
  EXPECT_THAT(held_bodies(scene_, {0, 0, 3, 0}, {}), IsEmpty());
}

TEST_F(SceneHoldTest, WhatCreepsIsNotSlipped) {
  move(2, 0.02, {0, 0, 0.02 - 0.7e-3});
  move(3, 0.03, {0, 0, 0.03 - 1.4e-3});
  const auto judged = [&](double slip_share) {
    HeldContacts contacts{.slip_speed_m_s = 0.1};
    for (int f = 0; f < 4; ++f) contacts.per_frame.push_back({.seconds = 0.01, .slip_share = slip_share});
    return held_bodies(scene_, {0, 0, 0, 0}, contacts)[0];
  };
  EXPECT_EQ(judged(0.2).outcome, "lifted");
  EXPECT_NEAR(judged(0.2).slip_m, 1.4e-3, 1e-12);
  EXPECT_NEAR(*judged(0.2).creep_m, 1.4e-3, 1e-12);
  EXPECT_EQ(judged(1.0).outcome, "slipped");
  EXPECT_EQ(judged(1.0).creep_m, 0.0);
  EXPECT_EQ(held()[0].outcome, "slipped");
  EXPECT_EQ(held()[0].creep_m, std::nullopt);
}

TEST_F(SceneHoldTest, ASingleGelHoldsNothing) {
  scene_.kinds[1] = "fixed";
  ASSERT_EQ(held().size(), 1u);
  EXPECT_EQ(held()[0].outcome, std::nullopt);
}

TEST_F(SceneHoldTest, ABodyThatNoGelTouchesIsNotListed) {
  for (int f = 1; f < 4; ++f) grip(f, 0.0);
  EXPECT_THAT(held(), IsEmpty());
  scene_.per_frame[1][0 * 4 + 3].force_n = {-1, 0, 0};  // the table, by the left gel
  EXPECT_THAT(held(), IsEmpty());
}

TEST_F(SceneHoldTest, TheRecordKeepsIt) {
  move(3, 0.05, {0.0004, 0, 0.05});
  const ScratchFolder scratch;
  scratch.file("press.yaml", to_yaml(Value::Map{{"summary", record_lines(SceneSummary{.held = held()})}}));
  const auto bodies = read_held(scratch / "");
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0].body, "block");
  EXPECT_EQ(bodies[0].freed_frame, 1u);
  EXPECT_EQ(bodies[0].outcome, "lifted");
  EXPECT_EQ(bodies[0].slip_m, held()[0].slip_m);
  EXPECT_EQ(bodies[0].hand_rise_m, held()[0].hand_rise_m);
  scratch.file("press.yaml", "summary: {frames: 2}\n");
  EXPECT_THAT(read_held(scratch / ""), IsEmpty());
}

}  // namespace scene_hold_test
}  // namespace tacipc
