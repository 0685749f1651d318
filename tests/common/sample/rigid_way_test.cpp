#include "common/sample/rigid_way.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

namespace tacipc {
namespace rigid_way_test {

TEST(RigidWay, AFrameTurnsAboutItsOwnOrigin) {
  Matrix4 pose = Matrix4::Identity();
  pose.topRightCorner<3, 1>() << 1, 2, 3;
  const Matrix4 after = moved(pose, {{0.5, 0, 0}, {0, 0, 0.5 * std::numbers::pi}});
  Matrix4 expected;
  expected << 0, -1, 0, 1.5, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1;
  EXPECT_LT((after - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(RigidWay, TheMotionOfTheWorldTakesThePoseAlong) {
  Matrix4 pose = Matrix4::Identity();
  pose.topRightCorner<3, 1>() << 1, 2, 3;
  pose.topLeftCorner<3, 3>() = Eigen::AngleAxisd(0.4, Vector3(1, 2, 2) / 3.0).toRotationMatrix();
  const RigidWay way{{0.1, -0.2, 0.3}, {0.2, 0.1, -0.3}};
  EXPECT_LT((motion_of_world(pose, way) * pose - moved(pose, way)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(RigidWay, AMillionSmallTurnsLeaveARotation) {
  Matrix4 pose = Matrix4::Identity();
  for (int i = 0; i < 1000000; ++i) pose = moved(pose, {Vector3::Zero(), {1e-3, 2e-3, -1e-3}});
  const Matrix3 R = pose.topLeftCorner<3, 3>();
  EXPECT_LT((R.transpose() * R - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(RigidWay, ASmoothWayBeginsAndEndsAtRest) {
  EXPECT_EQ(smooth_part(0.0), 0.0);
  EXPECT_EQ(smooth_part(0.5), 0.5);
  EXPECT_EQ(smooth_part(1.0), 1.0);
  EXPECT_LT(smooth_part(1e-4), 1e-7);
  EXPECT_GT(smooth_part(1.0 - 1e-4), 1.0 - 1e-7);
}

TEST(RigidWay, OnAPathAPoseIsMetToTheBitAndBetweenTwoItGoesEvenly) {
  const Matrix4 first = Matrix4::Identity(), last = moved(first, {{1, 2, 3}, {0, 0, 0.4}});
  const std::vector<Matrix4> path{first, last};
  EXPECT_EQ(pose_on_path(path, 1.0 - 1e-13), last);
  EXPECT_EQ(pose_on_path(path, 0.0), first);
  EXPECT_LT((pose_on_path(path, 0.25) - moved(first, {{0.25, 0.5, 0.75}, {0, 0, 0.1}})).cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace rigid_way_test
}  // namespace tacipc
